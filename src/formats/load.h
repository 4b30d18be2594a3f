// Loads a scene from a file of any supported format.
#pragma once

#include <filesystem>

#include "scene/scene.h"
#include "water/wave_simulation.h"

namespace nephroid {

// The scene in a .toml, .gltf or .glb file, as it stands at `time` (s). Everything in it has been checked:
// indices are in range, numbers are finite and in range, directions are unit. Throws InputError for whatever
// is wrong with it. With `waves`, simulated water continues from the state of the last call, so that a later
// time costs less.
Scene loadScene(const std::filesystem::path& file, double time = 0, WaveRuns* waves = nullptr);

}  // namespace nephroid
