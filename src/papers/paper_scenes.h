// The scenes of the papers' tables.
#pragma once

#include <filesystem>

#include "papers/paper_tables.h"
#include "scene/scene.h"

namespace nephroid {

// The folder that `bench` names; else share/nephroid beside the program's folder, where an installed program
// has them, or the source tree around it. Throws InputError, naming the places.
std::filesystem::path paperScenes(const PaperBench& bench);

// That of paper 3 with this name, in that folder.
Scene loadPaper3(const std::filesystem::path& folder, const std::string& name);

}  // namespace nephroid
