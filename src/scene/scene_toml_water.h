// The shape "water" of a scene file.
#pragma once

#include "scene/scene.h"
#include "scene/shapes.h"
#include "scene/toml_table.h"
#include "scene/wave_simulation.h"

namespace nephroid {

// "segments" or "vertices".
Density readDensity(TomlTable& table);

// At the scene's time; sets object.water.
Mesh readWater(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves);

}  // namespace nephroid
