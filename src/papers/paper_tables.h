// Measures the papers' tables again, and shows the paper's figures beside ours; and tables of our own.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "core/progress.h"

namespace nephroid {

// The value of a figure that does not exist.
inline constexpr double kNoFigure = std::numeric_limits<double>::quiet_NaN();

// One number of a table.
struct PaperFigure {
  std::string row;       // of the table: "figure 8 (a)"
  std::string quantity;  // "table size"
  std::string unit;
  double paper = kNoFigure;
  double ours = kNoFigure;
  double asked = kNoFigure;  // the value that ours should reach
  bool lessIsBetter = false;

  // How many times better than required the measured figure is.
  double ratio() const { return lessIsBetter ? asked / ours : ours / asked; }
};

struct PaperTable {
  std::string name;   // the name by which users select it
  std::string title;  // which table of which paper, and what it was measured on
  std::vector<PaperFigure> figures;
};

// The scenes and the device for the measurement.
struct PaperBench {
  std::filesystem::path scenes;  // the folder of the papers' scenes; empty: looked for by paperScenes
  std::string device;            // as gpu::DeviceOptions has it
  std::filesystem::path curves;  // where to write curves as SVG, for tables that have them; empty: nowhere
};

// In the order in which they are measured where none is named.
std::vector<std::string> paperTableNames();
// Names that stand for several tables.
std::vector<std::string> paperTableGroups();
// The tables that a name stands for: those of a group, or the one of this name.
std::vector<std::string> paperTablesNamed(const std::string& name);

// Measures one of paperTableNames() on this machine. Without a usable device, frame rates are left out, and
// the title gives the reason. Throws InputError where a scene is missing.
PaperTable measurePaperTable(const std::string& name, const PaperBench& bench, Progress& progress);

// Lines for a reader, and the same as JSON.
std::string describe(const PaperTable& table);
std::string paperTablesJson(const std::vector<PaperTable>& tables);

}  // namespace nephroid
