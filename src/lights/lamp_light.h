// The light of lamps with a size, point by point of the lamp.
#pragma once

#include "lights/light_intensity.h"

namespace nephroid {

// The light that falls on a point if nothing stands in the way. For a light with an extent, a sample of it.
struct Illumination {
  vec3 direction{0};    // unit, in which the light travels
  float distance = 0;   // m; infinite where it comes from afar
  vec3 illuminance{0};  // lux on a facing surface, without the loss in the air
};

// Whether a light is seen as more than a point. Skies have parts of their own.
bool hasSize(const Light& light);

// m, about middleOf(light): no point of the light is farther from there. 0 for light from afar.
float extentOf(const Light& light);

// Light toward `point` (m) from the place of the light that is chosen by `at`, two numbers in [0, 1); the
// mean over all is the light of the whole. Not for a sky. A ball has the same luminance all over, in each
// direction: what falls on a point where it is wholly in view is I cos / d2, as of a point light.
Illumination lampLight(const Light& light, const ShapedLight& shaped, vec3 point, vec2 at);

// Where light sets out from a lamp toward the unit vector `direction`, from the place chosen by `at`. Not for
// light from afar.
vec3 lampOrigin(const Light& light, vec3 direction, vec2 at);

// The direction, unit, in which a part of a directional light travels, and its lux on a surface that faces
// it.
struct LightFromAfar {
  vec3 direction{0};
  vec3 illuminance{0};
};
LightFromAfar lampFromAfar(const Light& light, vec2 at);

// 1 - cosine of the half angle that a ball is seen under; 2 from inside it.
float coneWidth(vec3 from, vec3 center, float radius);

}  // namespace nephroid
