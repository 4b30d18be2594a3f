// The medium between the objects, computed with the functions of optics/.
#pragma once

#include <algorithm>
#include <cmath>

#include "optics/air.h"
#include "scene/density_grid.h"
#include "scene/scene.h"
#include "scene/volume.h"

namespace nephroid {

inline Air airOf(const Medium& medium) {
  const float inverseFogHeight = medium.fogHeight > 0 ? 1 / medium.fogHeight : 0;
  return {medium.extinction, medium.albedo, medium.g, medium.fogBase, inverseFogHeight};
}

// The phase function (1/sr). `cosine`: between the directions of travel before and after.
inline float phaseOf(const Medium& medium, float cosine) {
  return phaseFunction(phaseCode(medium.phase), medium.g, cosine);
}

inline bool scatters(const Medium& medium) {
  return medium.extinction * medium.albedo > 0;
}

// The scattering coefficient (1/m) at a point.
inline float scatteringAt(const Medium& medium, vec3 point) {
  return medium.extinction * medium.albedo *
         (medium.grid ? densityAt(*medium.grid, point) : fogDensity(airOf(medium), point.y));
}

// The optical depth of the air along `direction` (unit): minus the natural logarithm of its transmittance.
// `length`: m, may be infinite.
inline float opticalDepth(const Medium& medium, vec3 from, vec3 direction, float length) {
  const Air air = airOf(medium);
  const float way = std::min(length, kFarthestAir);
  if (medium.grid) return medium.extinction * densityAlong(*medium.grid, from, direction, way);
  return air.extinction * meanFogDensity(air, from.y, from.y + way * direction.y) * way;
}

}  // namespace nephroid
