// The colors of steps from coarse to fine, for C++ and GLSL: each is brighter than the one before, so that
// they can be told apart without seeing colors.
#ifndef NEPHROID_TECHNIQUES_LEVEL_COLOR_H
#define NEPHROID_TECHNIQUES_LEVEL_COLOR_H

#include "core/shared_language.h"

SHARED_BEGIN

// sRGB, of step `level` where there are `count` of them.
SHARED_FUNCTION vec3 levelColor(uint level, uint count) {
  float place = count > 1u ? 4.0f * float(level) / float(count - 1u) : 4.0f;
  vec3 color = mix(vec3(0.30f, 0.36f, 0.92f), vec3(0.58f, 0.22f, 0.78f), clamp(place, 0.0f, 1.0f));
  color = mix(color, vec3(0.88f, 0.35f, 0.52f), clamp(place - 1.0f, 0.0f, 1.0f));
  color = mix(color, vec3(0.98f, 0.62f, 0.30f), clamp(place - 2.0f, 0.0f, 1.0f));
  return mix(color, vec3(0.99f, 0.94f, 0.40f), clamp(place - 3.0f, 0.0f, 1.0f));
}

SHARED_END

#endif
