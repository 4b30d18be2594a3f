// The constants of the pass that finds the parts of view rays in water, for C++ and GLSL.
#ifndef NEPHROID_RENDER_SIGHT_WAYS_DATA_H
#define NEPHROID_RENDER_SIGHT_WAYS_DATA_H

#include "gpu/buffer_address.h"

#include "core/shared_language.h"

SHARED_BEGIN

// Where a view ray in water begins: where it enters through the surface; where the surface has totally
// reflected it; or at the eye, which is in the water.
SHARED_CONSTANT uint kWayFromSurface = 0u;
SHARED_CONSTANT uint kWayReflected = 1u;
SHARED_CONSTANT uint kWayFromEye = 2u;

struct WayConstants {
  vec3 eye;  // m
  // The view ray at the place (x, y) of clip space has the direction middle + x * right + y * down.
  vec3 middle;
  vec3 right;
  vec3 down;
  uvec4 region;    // of the picture where casters may be: corner, size
  vec2 imageSize;  // pixels
  uint number;     // of the caster
  uint kind;       // kWay...
  float ior;       // in the middle channel
  float farthest;  // m, where nothing is met
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::WayConstants) <= 128);
#endif

#endif
