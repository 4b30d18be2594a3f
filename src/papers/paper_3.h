// Table 1 and figure 11 of paper 3.
#pragma once

#include "papers/paper_tables.h"

namespace nephroid {

PaperTable measurePaper3(const PaperBench& bench, Progress& progress);

}  // namespace nephroid
