// A sky as it is seen, for C++ and GLSL.
#ifndef NEPHROID_LIGHTS_SKY_SIGHT_H
#define NEPHROID_LIGHTS_SKY_SIGHT_H

#include "core/shared_language.h"

SHARED_BEGIN

struct SkySight {
  vec3 intensity;      // multiplies the map
  vec2 turn;           // cosine and sine of the angle by which the map is turned about +y
  vec3 disk;           // unit, toward its sun
  float diskRadius;    // sine of half the angle that the sun is seen under; 0: it has none
  vec3 diskLuminance;  // nit
#ifdef __cplusplus
  bool operator==(const SkySight&) const = default;
#endif
};

SHARED_END

#endif
