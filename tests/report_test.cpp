#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "report/paper_tables.h"

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

TEST(PaperTables, AreKnownByName) {
  Progress progress;
  EXPECT_FALSE(paperTableNames().empty());
  EXPECT_THROW(measurePaperTable("none", progress), InputError);
}

}  // namespace
}  // namespace nephroid
