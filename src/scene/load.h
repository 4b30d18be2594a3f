#pragma once

#include <filesystem>

#include "scene/scene.h"

namespace nephroid {

// The scene in a .toml, .gltf or .glb file, as it stands at `time` (s). Everything in it has been checked:
// indices are in range, numbers are finite and in range, directions are unit. Throws InputError for whatever
// is wrong with it.
Scene loadScene(const std::filesystem::path& file, double time = 0);

}  // namespace nephroid
