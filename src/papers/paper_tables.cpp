#include "papers/paper_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <span>

#include "core/error.h"
#include "geometry/shapes.h"
#include "papers/adaptive_beams_speed.h"
#include "papers/adaptive_beams_truth.h"
#include "papers/paper_3.h"
#include "papers/paper_4.h"
#include "papers/paper_5.h"
#include "papers/papers_1_2.h"
#include "papers/table_times.h"

namespace nephroid {
namespace {

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

PaperTable lightTransportTables(const PaperBench&, Progress& progress) {
  PaperTable table{"light-transport-table",
                   "Paper 1, table 1: light transport tables of 129 directions (theirs: ball, torus and "
                   "knot; ours: balls of "
                   "as many vertices)",
                   {}};
  for (const TableRow& row : kTableRows) {
    const TableTimes times = timeTable(makeSphere(0.5f, {.vertices = row.vertices}), vec3(1.5f), progress);
    table.figures.push_back({row.figure, "vertices", "", double(row.vertices), double(times.vertices)});
    table.figures.push_back({row.figure, "table size", "MB", row.megabytes, double(times.bytes) / 1e6});
    table.figures.push_back({row.figure, "preprocessing", "s", row.hours * 3600, times.seconds});
  }
  return table;
}

struct Entry {
  const char* name;
  PaperTable (*measure)(const PaperBench&, Progress&);
  const char* group = nullptr;
};
constexpr const char* kAdaptiveBeams = "adaptive-beams";
constexpr std::array<Entry, 8> kTables{{{"light-transport-table", lightTransportTables},
                                        {"papers-1-2", measurePapers1And2},
                                        {"paper-3", measurePaper3},
                                        {"paper-4", measurePaper4},
                                        {"paper-5", measurePaper5},
                                        {"adaptive-beams-truth", measureAdaptiveTruth, kAdaptiveBeams},
                                        {"adaptive-beams-error", measureAdaptiveError, kAdaptiveBeams},
                                        {"adaptive-beams-speed", measureAdaptiveSpeed, kAdaptiveBeams}}};

// A line for each row, and beside it for each quantity what the paper has and what is asked for (where there
// is something), what is measured here and how many times as good as asked that is.
class Layout {
 public:
  explicit Layout(const std::vector<PaperFigure>& figures) {
    for (const PaperFigure& figure : figures) {
      rowWidth_ = std::max(rowWidth_, figure.row.size());
      Column& column = columnOf(figure);
      column.isAsked = column.isAsked || !std::isnan(figure.asked);
      column.isInPaper = column.isInPaper || !std::isnan(figure.paper);
    }
  }

  std::string head() const {
    std::string names = padded("", rowWidth_), parts = names;
    for (const Column& column : columns_) {
      std::string own;
      if (column.isInPaper) own += toTheRight("paper");
      if (column.isAsked) own += toTheRight("asked");
      own += toTheRight("here");
      if (column.isAsked) own += toTheRight("ratio");
      names += "  " + padded(column.name, own.size());
      parts += "  " + padded(own, column.name.size());
    }
    return names + "\n" + parts + "\n";
  }

  std::string line(std::span<const PaperFigure> row) const {
    std::string text = padded(row.front().row, rowWidth_);
    for (const Column& column : columns_) {
      const auto found =
          std::ranges::find_if(row, [&](const PaperFigure& f) { return nameOf(f) == column.name; });
      const PaperFigure figure = found == row.end() ? PaperFigure{} : *found;
      std::string own;
      if (column.isInPaper) own += number(figure.paper);
      if (column.isAsked) own += number(figure.asked);
      own += number(figure.ours);
      if (column.isAsked) own += number(figure.ratio());
      text += "  " + padded(own, column.name.size());
    }
    return text + "\n";
  }

 private:
  static constexpr std::size_t kNumberWidth = 8;
  struct Column {
    std::string name;
    bool isAsked = false;
    bool isInPaper = false;
  };

  static std::string nameOf(const PaperFigure& figure) {
    return figure.quantity + (figure.unit.empty() ? "" : " (" + figure.unit + ")");
  }
  static std::string padded(std::string text, std::size_t width) {
    text.resize(std::max(text.size(), width), ' ');
    return text;
  }
  static std::string toTheRight(const std::string& text) {
    return std::string(kNumberWidth - std::min(text.size(), kNumberWidth), ' ') + text;
  }
  static std::string number(double value) {
    if (std::isnan(value)) return toTheRight("-");
    char text[32];
    std::snprintf(text, sizeof text, value < 1000 ? "%.3g" : "%.0f", value);
    return toTheRight(text);
  }

  Column& columnOf(const PaperFigure& figure) {
    const std::string name = nameOf(figure);
    const auto known = std::ranges::find(columns_, name, &Column::name);
    if (known != columns_.end()) return *known;
    return columns_.emplace_back(Column{name});
  }

  std::size_t rowWidth_ = 0;
  std::vector<Column> columns_;
};

}  // namespace

std::vector<std::string> paperTableNames() {
  std::vector<std::string> names;
  for (const Entry& entry : kTables) names.emplace_back(entry.name);
  return names;
}

std::vector<std::string> paperTableGroups() {
  return {kAdaptiveBeams};
}

std::vector<std::string> paperTablesNamed(const std::string& name) {
  std::vector<std::string> names;
  for (const Entry& entry : kTables)
    if (name == entry.name || (entry.group && name == entry.group)) names.emplace_back(entry.name);
  return names;
}

PaperTable measurePaperTable(const std::string& name, const PaperBench& bench, Progress& progress) {
  for (const Entry& entry : kTables)
    if (name == entry.name) return entry.measure(bench, progress);
  std::string all;
  for (const Entry& entry : kTables) all += (all.empty() ? "" : ", ") + std::string(entry.name);
  throw InputError("there is no table '" + name + "' in this version; there are: " + all);
}

std::string describe(const PaperTable& table) {
  const Layout layout(table.figures);
  std::string text = table.title + "\n" + layout.head();
  const std::span<const PaperFigure> figures = table.figures;
  for (std::size_t first = 0, last; first < figures.size(); first = last) {
    for (last = first; last < figures.size() && figures[last].row == figures[first].row;) ++last;
    text += layout.line(figures.subspan(first, last - first));
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
                         {"asked", figure.asked},
                         {"ours", figure.ours},
                         {"ratio", figure.ratio()}});
    document.push_back({{"name", table.name}, {"title", table.title}, {"figures", figures}});
  }
  return document.dump(2) + "\n";
}

}  // namespace nephroid
