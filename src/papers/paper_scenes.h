// The scenes of the papers' tables.
#pragma once

#include <filesystem>

#include "papers/paper_tables.h"
#include "scene/scene.h"

namespace nephroid {

// The folder of the papers' scenes: the one in `bench`; without it, share/nephroid beside the program's
// folder (an installed program), or the source tree around the program. Throws InputError, with these places,
// where none exists.
std::filesystem::path paperScenes(const PaperBench& bench);

// Loads the scene of paper 3 with this name from that folder.
Scene loadPaper3(const std::filesystem::path& folder, const std::string& name);

}  // namespace nephroid
