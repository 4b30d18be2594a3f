// Saves a scene that was changed after it was loaded.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

struct SavedScene {
  std::string text;
  std::vector<std::string> notSaved;  // names of changed things that cannot be written in the file
};

// `text` is the text of the .toml file from which `before` was loaded. Returns a text from which `after`
// would be loaded. Both scenes have the same objects, lights and materials. Values that differ are replaced
// in the text, and everything else stays as it was written. Where a value that was changed by hand had a cue
// (a list of times and values), the cue is replaced by the value. Throws InputError where `text` is not a
// scene.
SavedScene savedScene(const std::string& text, const Scene& before, const Scene& after);

// The text of a scene file that imports all of `file`, a .gltf or .glb. It has to be stored in the folder of
// `file`.
std::string sceneAround(const std::filesystem::path& file);

}  // namespace nephroid
