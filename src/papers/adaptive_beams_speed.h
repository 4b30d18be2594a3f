// How fast the technique adaptive-beams makes light, beside the other techniques.
#pragma once

#include "papers/paper_tables.h"

namespace nephroid {

PaperTable measureAdaptiveSpeed(const PaperBench& bench, Progress& progress);

}  // namespace nephroid
