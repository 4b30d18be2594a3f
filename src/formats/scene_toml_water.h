// The shape "water" of a scene file.
#pragma once

#include "formats/toml_table.h"
#include "geometry/shapes.h"
#include "scene/scene.h"
#include "water/water.h"
#include "water/wave_simulation.h"

namespace nephroid {

// Reads the key "segments" or "vertices".
Density readDensity(TomlTable& table);

// Makes the mesh of water at the scene's time, and sets object.water.
Mesh readWater(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves);

}  // namespace nephroid
