// A sensor's caustics by the mesh of rays alone, without a device.
#pragma once

#include <vector>

#include "beams/ray_mesh/ray_mesh.h"
#include "core/progress.h"

namespace nephroid {

struct SensorAccuracy {
  float error = 0.01f;  // root mean square over the mean of the sensor
  Paths paths = Paths::all;
  uint64_t mostBytes = uint64_t{1} << 30;  // of the paths
};

// lux of each texel, rows first: light that met a caster. `mesh` is what it was made of. The same bytes for
// any number of threads.
std::vector<vec3> lightOnSensor(const Scene& scene, const RayScene& rays, const Sensor& sensor,
                                const SensorAccuracy& accuracy, RayMesh& mesh, Progress& progress);

}  // namespace nephroid
