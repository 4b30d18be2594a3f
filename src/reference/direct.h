// Direct light: light that met no caster.
#pragma once

#include "reference/boundary.h"
#include "reference/lights.h"

namespace nephroid {

// A point to be lit, and the medium around it.
struct LitPoint {
  vec3 position{0};
  vec3 normal{0};           // unit, shading
  vec3 geometricNormal{0};  // unit, on the side that is lit
  uint32_t medium = kNone;  // object around it
  float rounding = 0;       // m, across the surface, that the place may be off
};

// Illuminance (lux) by one light, with a shadow ray. The air weakens lights on their way, except directional
// lights, whose given illuminance is valid everywhere in the air. `u` in [0, 1): the place on the light.
vec3 directIlluminance(const Boundaries& boundaries, const Lights& lights, uint32_t light,
                       const LitPoint& point, float u);

// Whether nothing stands between `point` and the light of `illumination`. `clearance`: m, the beginning of
// the way that is not tested.
bool isLit(const RayScene& rays, const Illumination& illumination, vec3 point, float clearance);

}  // namespace nephroid
