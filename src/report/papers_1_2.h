// Table 1 of paper 1 and the results of paper 2, figure by figure.
#pragma once

#include "report/paper_tables.h"

namespace nephroid {

PaperTable measurePapers1And2(const PaperBench& bench, Progress& progress);

// Where the scenes are: in share/nephroid beside the program's folder, where an installed program has them,
// or in the source tree around it. Throws InputError, naming the places.
std::filesystem::path findPaperScenes();

}  // namespace nephroid
