// Table 1 of paper 1 and the results of paper 2, figure by figure.
#pragma once

#include "papers/paper_tables.h"

namespace nephroid {

PaperTable measurePapers1And2(const PaperBench& bench, Progress& progress);

}  // namespace nephroid
