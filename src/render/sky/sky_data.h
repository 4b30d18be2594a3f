// The constants of the pass that draws skies, for C++ and GLSL.
#ifndef NEPHROID_RENDER_SKY_SKY_DATA_H
#define NEPHROID_RENDER_SKY_SKY_DATA_H

#include "lights/sky_sight.h"

SHARED_BEGIN

// By which way a pixel sees the sky.
SHARED_CONSTANT uint kSkyOpen = 0u;       // nothing is in between
SHARED_CONSTANT uint kSkyThrough = 1u;    // through a caster, or in a mirror
SHARED_CONSTANT uint kSkyReflected = 2u;  // reflected by the outside of glass

struct SkyConstants {
  SkySight sight;
  // Of PictureRays.
  vec3 middle;
  vec3 right;
  vec3 down;
  vec2 imageSize;  // pixels
  vec3 eye;        // m
  float width;     // of a look: radians, in the middle of an open picture
  float spacing;   // of samples, pixels
  int levels;      // of the map
  uint number;     // of the caster: its object + 1
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::SkyConstants) <= 128);
#endif

#endif
