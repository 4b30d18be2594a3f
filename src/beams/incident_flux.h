// What a light sends onto a triangle of a caster.
#pragma once

#include "lights/light_intensity.h"

namespace nephroid {

// lm from the emitter, which is one of `light`, onto a triangle, counted positive where its front
// (counter-clockwise) faces the light. A gobo is averaged texel by texel.
vec3 fluxOnto(const ShapedLight& light, const Emitter& emitter, vec3 a, vec3 b, vec3 c);

}  // namespace nephroid
