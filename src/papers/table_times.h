#pragma once

#include "core/progress.h"
#include "scene/scene.h"

namespace nephroid {

// Light transport tables of 129 directions, made from nothing.
struct TableTimes {
  std::size_t vertices = 0;
  std::size_t bytes = 0;
  double seconds = 0;  // median of a few runs
};

TableTimes timeTable(const Mesh& mesh, vec3 ior, Progress& progress);

// Those of a scene's casters, each mesh and index of refraction once.
TableTimes timeTables(const Scene& scene, Progress& progress);

}  // namespace nephroid
