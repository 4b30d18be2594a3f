// The flux that a light sends onto a triangle of a caster.
#pragma once

#include "lights/light_intensity.h"

namespace nephroid {

// The flux (lm) from one emitter of `light` onto a triangle (corners in m). It is positive where the
// triangle's front (counterclockwise) faces the light. A gobo is averaged over its texels.
vec3 fluxOnto(const ShapedLight& light, const Emitter& emitter, vec3 a, vec3 b, vec3 c);

}  // namespace nephroid
