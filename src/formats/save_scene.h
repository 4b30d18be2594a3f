// A scene that was changed after it was loaded, as the file it would be loaded from.
#pragma once

#include <string>
#include <vector>

#include "scene/scene.h"

namespace nephroid {

struct SavedScene {
  std::string text;
  std::vector<std::string> notSaved;  // names of what was changed and has no place in the file
};

// `text` is that of the .toml file that `before` is loaded from at its time; it comes back changed so that
// `after` would be: all that differs, of the same objects, lights and materials, is written over what stands
// there, and everything else stays. Where a light's cue says what was changed by hand, the cue ends. Throws
// InputError where `text` is not a scene.
SavedScene savedScene(const std::string& text, const Scene& before, const Scene& after);

// The text of a scene that is all of `file`, a .gltf or .glb, beside which it is to lie.
std::string sceneAround(const std::filesystem::path& file);

}  // namespace nephroid
