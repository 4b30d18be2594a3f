// The scenes of the papers' tables.
#pragma once

#include <filesystem>

#include "papers/paper_tables.h"
#include "scene/scene.h"
#include "techniques/settings.h"

namespace nephroid {

// The folder of the papers' scenes: the one in `bench`; without it, share/nephroid beside the program's
// folder (an installed program), or the source tree around the program. Throws InputError, with these places,
// where none exists.
std::filesystem::path paperScenes(const PaperBench& bench);

// Loads the scene of paper 3 with this name from that folder.
Scene loadPaper3(const std::filesystem::path& folder, const std::string& name);

// As the papers have it: rays of light transport tables, refracted alone.
inline TechniqueSettings papersSettings(const char* technique) {
  TechniqueSettings settings;
  settings.technique = technique;
  settings.transport.source = Source::table;
  settings.transport.paths = Paths::transmission;
  return settings;
}

}  // namespace nephroid
