// Light that met no caster.
#pragma once

#include "reference/boundary.h"
#include "reference/lights.h"

namespace nephroid {

// A place that is lit, and what it is inside of.
struct LitPoint {
  vec3 position{0};
  vec3 normal{0};           // unit, shading
  vec3 geometricNormal{0};  // unit, on the side that is lit
  uint32_t medium = kNone;  // object around it
  float clearance = 0;      // m of a shadow ray that are not looked at
};

// Illuminance (lux) by one light along a shadow ray. A directional light is as strong in the air as it is
// said to be; others are weakened by it on their way.
vec3 directIlluminance(const Boundaries& boundaries, const Lights& lights, uint32_t light,
                       const LitPoint& point, Random& random);

// Whether light along `illumination` comes to `point` without meeting anything.
bool isLit(const RayScene& rays, const Illumination& illumination, vec3 point, float clearance);

}  // namespace nephroid
