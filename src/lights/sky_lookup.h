// Looks up the luminance of a sky. Written once for C++ and GLSL.
//
// A shader defines these before it includes this file; C++ has them in seen_skies.h:
//
//   struct SkyView                                      a map and its coarser levels
//   int skyLevelCount(SkyView sky)
//   ivec2 skyLevelSize(SkyView sky, int level)          columns and rows
//   vec3 skyTexel(SkyView sky, ivec2 at, int level)     nit
#ifndef NEPHROID_LIGHTS_SKY_LOOKUP_H
#define NEPHROID_LIGHTS_SKY_LOOKUP_H

#include "lights/sky_sight.h"

SHARED_BEGIN

// The place of a direction (unit) in a map: (0, 0) is the upper left corner, (1, 1) the lower right one.
SHARED_FUNCTION vec2 placeInSky(vec3 toward) {
  const float kInversePi = 0.318309886f;
  float level = sqrt(toward.x * toward.x + toward.z * toward.z);
  float longitude = level > 0.0f ? atan(toward.x, -toward.z) : 0.0f;
  return vec2(0.5f + 0.5f * kInversePi * longitude, 0.5f - kInversePi * atan(toward.y, level));
}

// Linear between the middles of cells.
SHARED_FUNCTION vec3 linearInSky(SkyView sky, int level, vec2 place) {
  ivec2 size = skyLevelSize(sky, level);
  vec2 at = place * vec2(size) - 0.5f;
  vec2 low = floor(at);
  vec2 part = at - low;
  int left = (int(low.x) + size.x) % size.x;
  int right = (left + 1) % size.x;
  int upper = clamp(int(low.y), 0, size.y - 1);
  int lower = clamp(int(low.y) + 1, 0, size.y - 1);
  return mix(mix(skyTexel(sky, ivec2(left, upper), level), skyTexel(sky, ivec2(right, upper), level), part.x),
             mix(skyTexel(sky, ivec2(left, lower), level), skyTexel(sky, ivec2(right, lower), level), part.x),
             part.y);
}

// The part of a look of this width (radians) that a disk covers, around the unit vector `disk`. `radius`:
// sine of half the angle that it is seen under. A look wider than the disk sees a wider and fainter one: the
// mean over all directions stays the same.
SHARED_FUNCTION float diskCoverage(vec3 toward, vec3 disk, float radius, float width) {
  if (dot(toward, disk) <= 0.0f) return 0.0f;
  float aside = length(cross(toward, disk));
  float spread = max(radius, 0.5f * width);
  float edge = clamp(width, 1e-9f, 2.0f * spread);
  float covered = clamp((spread - aside) / edge + 0.5f, 0.0f, 1.0f);
  return covered * radius * radius / (spread * spread + edge * edge / 12.0f);
}

// Luminance (nit) in the direction `toward` (unit, world space), filtered over `width` (radians; 0: none).
SHARED_FUNCTION vec3 skyLuminance(SkyView sky, SkySight sight, vec3 toward, float width) {
  vec3 inMap = vec3(sight.turn.x * toward.x - sight.turn.y * toward.z, toward.y,
                    sight.turn.y * toward.x + sight.turn.x * toward.z);
  vec2 place = placeInSky(inMap);
  float rows = float(skyLevelSize(sky, 0).y) * 0.318309886f;  // in a radian
  float level = clamp(log2(max(width * rows, 1.0f)), 0.0f, float(skyLevelCount(sky) - 1));
  int finer = int(level);
  float part = level - float(finer);
  vec3 seen = linearInSky(sky, finer, place);
  if (part > 0.0f) seen = mix(seen, linearInSky(sky, finer + 1, place), part);
  seen *= sight.intensity;
  if (sight.diskRadius > 0.0f)
    seen += sight.diskLuminance * diskCoverage(toward, sight.disk, sight.diskRadius, width);
  return seen;
}

SHARED_END

#endif
