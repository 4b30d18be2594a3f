// The papers' tables measured again: theirs beside ours.
#pragma once

#include <string>
#include <vector>

#include "core/progress.h"

namespace nephroid {

// One number of a table.
struct PaperFigure {
  std::string row;       // of the table: "figure 8 (a)"
  std::string quantity;  // "table size"
  std::string unit;
  double paper = 0;
  double ours = 0;
};

struct PaperTable {
  std::string name;   // what a user asks for it by
  std::string title;  // which table of which paper, and what the paper measured on
  std::vector<PaperFigure> figures;
};

std::vector<std::string> paperTableNames();

// Measures one of paperTableNames() on this machine.
PaperTable measurePaperTable(const std::string& name, Progress& progress);

// Lines for a reader, and the same as JSON.
std::string describe(const PaperTable& table);
std::string paperTablesJson(const std::vector<PaperTable>& tables);

}  // namespace nephroid
