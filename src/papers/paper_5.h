// Tables 1 and 2 of paper 5, view by view and grid by grid.
#pragma once

#include "papers/paper_tables.h"

namespace nephroid {

PaperTable measurePaper5(const PaperBench& bench, Progress& progress);

}  // namespace nephroid
