#include "report/paper_tables.h"

#include <array>
#include <chrono>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "core/stats.h"
#include "scene/shapes.h"
#include "transport/table/table.h"

namespace nephroid {
namespace {

using Clock = std::chrono::steady_clock;

// Iwasaki 2005 ("A Method for Fast Rendering of Caustics"), table 1: rows with one caster of a shape that is
// at hand.
struct TableRow {
  const char* figure;
  uint32_t vertices;
  double megabytes;
  double hours;
};
constexpr std::array<TableRow, 3> kTableRows{{{"figure 8 (a)", 6400, 10.6, 1.2},
                                              {"figure 9 (b)", 12800, 21.1, 4.0},
                                              {"figure 11 (b)", 5100, 8.4, 1.0}}};

constexpr int kRuns = 3;

double medianBuildSeconds(const Mesh& mesh, std::size_t& bytes, Progress& progress) {
  std::vector<double> seconds;
  for (int run = 0; run < kRuns; ++run) {
    const auto start = Clock::now();
    bytes = buildTable(mesh, vec3(1.5f), {}, progress).sizeInBytes();
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
  }
  return median(seconds);
}

PaperTable lightTransportTables(Progress& progress) {
  PaperTable table{"light-transport-table",
                   "Paper 1, table 1: light transport tables of 129 directions (theirs: ball, torus and "
                   "knot; ours: balls of "
                   "as many vertices)",
                   {}};
  for (const TableRow& row : kTableRows) {
    const Mesh ball = makeSphere(0.5f, {.vertices = row.vertices});
    std::size_t bytes = 0;
    const double seconds = medianBuildSeconds(ball, bytes, progress);
    table.figures.push_back(
        {row.figure, "vertices", "", double(row.vertices), double(ball.positions.size())});
    table.figures.push_back({row.figure, "table size", "MB", row.megabytes, double(bytes) / 1e6});
    table.figures.push_back({row.figure, "preprocessing", "s", row.hours * 3600, seconds});
  }
  return table;
}

struct Entry {
  const char* name;
  PaperTable (*measure)(Progress&);
};
constexpr std::array<Entry, 1> kTables{{{"light-transport-table", lightTransportTables}}};

}  // namespace

std::vector<std::string> paperTableNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kTables) names.emplace_back(entry.name);
  return names;
}

PaperTable measurePaperTable(const std::string& name, Progress& progress) {
  for (const Entry& entry : kTables)
    if (name == entry.name) return entry.measure(progress);
  throw InputError("there is no table '" + name + "' in this version; there is: " + kTables[0].name);
}

std::string describe(const PaperTable& table) {
  std::string text = table.title + "\n";
  char line[160];
  std::snprintf(line, sizeof line, "  %-14s %-14s %12s %12s\n", "", "", "paper", "here");
  text += line;
  for (const PaperFigure& figure : table.figures) {
    std::snprintf(line, sizeof line, "  %-14s %-14s %12.5g %12.5g %s\n", figure.row.c_str(),
                  figure.quantity.c_str(), figure.paper, figure.ours, figure.unit.c_str());
    text += line;
  }
  return text;
}

std::string paperTablesJson(const std::vector<PaperTable>& tables) {
  using Json = nlohmann::ordered_json;
  Json document = Json::array();
  for (const PaperTable& table : tables) {
    Json figures = Json::array();
    for (const PaperFigure& figure : table.figures)
      figures.push_back({{"row", figure.row},
                         {"quantity", figure.quantity},
                         {"unit", figure.unit},
                         {"paper", figure.paper},
                         {"ours", figure.ours}});
    document.push_back({{"name", table.name}, {"title", table.title}, {"figures", figures}});
  }
  return document.dump(2) + "\n";
}

}  // namespace nephroid
