// Figures 4 to 7 of paper 4 (Dobashi 2002).
#pragma once

#include "papers/paper_tables.h"

namespace nephroid {

// Writes its curves to the file bench.curves, if it is given.
PaperTable measurePaper4(const PaperBench& bench, Progress& progress);

}  // namespace nephroid
