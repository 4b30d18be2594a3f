// Measures the time to make light transport tables, and their size.
#pragma once

#include "core/progress.h"
#include "scene/scene.h"

namespace nephroid {

// The size and time of light transport tables of 129 directions, made without a cache.
struct TableTimes {
  std::size_t vertices = 0;
  std::size_t bytes = 0;
  double seconds = 0;  // median of a few runs
};

TableTimes timeTable(const Mesh& mesh, vec3 ior, Progress& progress);

// The sum over a scene's casters; each mesh and index of refraction counts once.
TableTimes timeTables(const Scene& scene, Progress& progress);

}  // namespace nephroid
