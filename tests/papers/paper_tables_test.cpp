#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "core/error.h"
#include "papers/paper_tables.h"

namespace nephroid {
namespace {

const PaperTable kTable{"name", "Paper 0, table 1", {{"figure 1", "table size", "MB", 10.6, 12.25}}};

TEST(PaperTables, SetTheirFiguresBesideOurs) {
  const std::string text = describe(kTable);
  EXPECT_EQ(text.rfind("Paper 0, table 1\n", 0), 0u);
  EXPECT_LT(text.find("10.6"), text.find("12.25"));
  const auto json = nlohmann::json::parse(paperTablesJson({kTable}));
  EXPECT_EQ(json[0]["figures"][0]["paper"], 10.6);
  EXPECT_EQ(json[0]["figures"][0]["ours"], 12.25);
}

TEST(PaperTables, SayWhatIsAskedAndHowFarItIsReached) {
  const PaperTable table{"name",
                         "title",
                         {{"figure 1", "time", "s", 3600, 0.5, 0.75, true},
                          {"figure 1", "rate", "1/s", 5.1, 15.3, 10.2},
                          {"figure 2", "rate", "1/s", 7, kNoFigure, 14}}};
  EXPECT_DOUBLE_EQ(table.figures[0].ratio(), 1.5);
  EXPECT_DOUBLE_EQ(table.figures[1].ratio(), 1.5);
  std::istringstream lines(describe(table));
  std::string line;
  for (int i = 0; i < 4; ++i) std::getline(lines, line);
  std::istringstream first(line.substr(std::string("figure 1").size()));
  for (const double expected : {3600.0, 0.75, 0.5, 1.5, 5.1, 10.2, 15.3, 1.5}) {
    double value = 0;
    first >> value;
    EXPECT_EQ(value, expected) << line;
  }
  std::getline(lines, line);
  EXPECT_EQ(std::count(line.begin(), line.end(), '-'), 6) << line;
  const auto json = nlohmann::json::parse(paperTablesJson({table}));
  EXPECT_EQ(json[0]["figures"][1]["asked"], 10.2);
  EXPECT_TRUE(json[0]["figures"][2]["ours"].is_null());
}

TEST(PaperTables, OfOurOwnHaveNoColumnForAPaper) {
  const PaperTable table{"name", "title", {{"scene", "time", "ms", kNoFigure, 2.5}}};
  const std::string text = describe(table);
  EXPECT_EQ(text.find("paper"), std::string::npos) << text;
  EXPECT_EQ(text.find('-'), std::string::npos) << text;
  EXPECT_NE(text.find("2.5"), std::string::npos) << text;
}

TEST(PaperTables, AreKnownByName) {
  Progress progress;
  EXPECT_FALSE(paperTableNames().empty());
  EXPECT_EQ(paperTablesNamed("paper-3"), std::vector<std::string>{"paper-3"});
  for (const std::string& group : paperTableGroups()) EXPECT_GT(paperTablesNamed(group).size(), 1u) << group;
  EXPECT_TRUE(paperTablesNamed("none").empty());
  EXPECT_THROW(measurePaperTable("none", {}, progress), InputError);
}

}  // namespace
}  // namespace nephroid
