// The scenes of the papers' tables.
#pragma once

#include <filesystem>

#include "report/paper_tables.h"

namespace nephroid {

// The folder that `bench` names; else share/nephroid beside the program's folder, where an installed program
// has them, or the source tree around it. Throws InputError, naming the places.
std::filesystem::path paperScenes(const PaperBench& bench);

}  // namespace nephroid
