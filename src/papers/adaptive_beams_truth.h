// The technique adaptive-beams against counted light: how right it is, and whether it keeps the error that is
// asked for.
#pragma once

#include "papers/paper_tables.h"

namespace nephroid {

PaperTable measureAdaptiveTruth(const PaperBench& bench, Progress& progress);
PaperTable measureAdaptiveError(const PaperBench& bench, Progress& progress);

}  // namespace nephroid
