// What the pass is told that finds lines of sight in water, for C++ and GLSL.
#ifndef NEPHROID_RENDER_SIGHT_WAYS_DATA_H
#define NEPHROID_RENDER_SIGHT_WAYS_DATA_H

#include "gpu/buffer_address.h"

#include "core/shared_language.h"

SHARED_BEGIN

// Where ways of sight begin: where sight enters the water; at an eye in it; or where the surface has
// reflected sight from there totally.
SHARED_CONSTANT uint kWayFromSurface = 0u;
SHARED_CONSTANT uint kWayReflected = 1u;
SHARED_CONSTANT uint kWayFromEye = 2u;

struct WayConstants {
  vec3 eye;  // m
  // A ray of sight at the place (x, y) of clip space goes along middle + x * right + y * down.
  vec3 middle;
  vec3 right;
  vec3 down;
  uvec4 region;    // of the picture where casters may be: corner, size
  vec2 imageSize;  // pixels
  uint number;     // of the caster; 0: it is not in the picture
  uint kind;       // kWay...
  float ior;       // in the middle channel
  float farthest;  // m, where nothing is met
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::WayConstants) <= 128);
#endif

#endif
