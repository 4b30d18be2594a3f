// The shape "water" of a scene file.
#pragma once

#include "formats/toml_table.h"
#include "geometry/shapes.h"
#include "scene/scene.h"
#include "water/water.h"
#include "water/wave_simulation.h"

namespace nephroid {

// "segments" or "vertices".
Density readDensity(TomlTable& table);

// At the scene's time; sets object.water.
Mesh readWater(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves);

}  // namespace nephroid
