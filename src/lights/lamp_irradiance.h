// The light of lamps with a size on a point that sees all of them, in closed form. Written once for C++ and
// GLSL.
#ifndef NEPHROID_LIGHTS_LAMP_IRRADIANCE_H
#define NEPHROID_LIGHTS_LAMP_IRRADIANCE_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT float kHalfTurn = 3.14159265f;
// A panel or a segment that is seen smaller than this (size over distance, squared) is as a point.
SHARED_CONSTANT float kSmallestSquare = 1e-6f;

// A disk that is seen under less than the root of this is as a flat one.
SHARED_CONSTANT float kFlatDisk = 1e-3f;

// Of an evenly bright disk or ball that is seen under the half angle `sigma`, in the direction at `cosine` to
// a surface's normal: its light on the surface, over that on a surface that faces it. Where the horizon cuts
// it, a part counts (Lagarde and de Rousiers 2014, listing 7; for small ones the integral over the part of a
// flat disk, whose terms do not cancel). `sineSquared`: of sigma.
SHARED_FUNCTION float diskCosine(float cosine, float sineSquared) {
  if (cosine * cosine >= sineSquared) return max(cosine, 0.0f);
  if (sineSquared < kFlatDisk) {
    const float above = cosine / sqrt(sineSquared);  // of its radius
    const float chord = sqrt(max(1.0f - above * above, 0.0f));
    const float part = above * (acos(-above) + above * chord) + chord * chord * chord * (2.0f / 3.0f);
    return sqrt(sineSquared) * part / kHalfTurn;
  }
  const float sine = sqrt(max(1.0f - cosine * cosine, 1e-12f));
  const float x = sqrt(max(1.0f / sineSquared - 1.0f, 1e-12f));
  const float y = clamp(-x * cosine / sine, -1.0f, 1.0f);
  const float rest = sine * sqrt(1.0f - y * y);
  const float lit = (cosine * acos(y) - x * rest) * sineSquared + atan(rest / x);
  return max(lit, 0.0f) / (kHalfTurn * sineSquared);
}

// The part of an edge from `a` to `b` (m, from the point) in the sum over a polygon's edges: the angle that
// it is seen under, times the normal's part across the plane through edge and point.
SHARED_FUNCTION float edgeTerm(vec3 a, vec3 b, vec3 normal) {
  const vec3 across = cross(a, b);
  const float size = length(across);
  return size > 0.0f ? atan(size, dot(a, b)) * dot(across, normal) / size : 0.0f;
}

// The integral of cos cos' / d2 over the part above the horizon of a parallelogram with the corner `corner`
// (m, from the point) and the sides `u` and `v`, which shines to the side of cross(v, u) (Lambert 1760). Its
// light is its intensity along its normal, over its area, times this.
SHARED_FUNCTION float panelIntegral(vec3 corner, vec3 u, vec3 v, vec3 normal) {
  const vec3 front = cross(v, u);
  const vec3 middle = corner + 0.5f * (u + v);
  if (dot(front, corner) >= 0.0f) return 0.0f;
  const float squared = dot(middle, middle), area = length(front);
  if (area < kSmallestSquare * squared)
    return max(dot(normal, middle), 0.0f) * -dot(front, middle) / (squared * squared);
  const vec3 sides[4] = {u, v, -u, -v};
  vec3 here = corner, leaves = vec3(0.0f), returns = vec3(0.0f);
  float height = dot(normal, here), sum = 0.0f;
  bool isCut = false;
  for (int i = 0; i < 4; ++i) {
    const vec3 next = here + sides[i];
    const float nextHeight = dot(normal, next);
    if (height > 0.0f || nextHeight > 0.0f) {
      const vec3 horizon = here + sides[i] * (height / (height - nextHeight));
      if (nextHeight <= 0.0f) {
        sum += edgeTerm(here, horizon, normal);
        leaves = horizon;
        isCut = true;
      } else if (height <= 0.0f) {
        sum += edgeTerm(horizon, next, normal);
        returns = horizon;
        isCut = true;
      } else {
        sum += edgeTerm(here, next, normal);
      }
    }
    here = next;
    height = nextHeight;
  }
  if (isCut) sum += edgeTerm(leaves, returns, normal);
  return 0.5f * abs(sum);
}

// The integral of cos / d2 along the part above the horizon of a segment that begins at `start` (m, from the
// point). Its light is its intensity, over its length, times this.
SHARED_FUNCTION float segmentIntegral(vec3 start, vec3 side, vec3 normal) {
  const float size = length(side);
  const vec3 along = side / size;
  const vec3 middle = start + 0.5f * side;
  const float squared = dot(middle, middle);
  if (size * size < kSmallestSquare * squared)
    return size * max(dot(normal, middle), 0.0f) / (squared * sqrt(squared));
  const float from = dot(start, along);
  const vec3 foot = start - from * along;  // of the point on the segment's line
  const float rise = dot(normal, along), level = dot(normal, foot);
  float low = from, high = from + size;
  // Above the horizon: level + rise * s > 0.
  if (rise > 0.0f) low = max(low, -level / rise);
  if (rise < 0.0f) high = min(high, -level / rise);
  if (high <= low || (rise == 0.0f && level <= 0.0f)) return 0.0f;
  const float away = max(dot(foot, foot), 1e-12f * squared);
  const float a = sqrt(away + low * low), b = sqrt(away + high * high);
  return max(level / away * (high / b - low / a) - rise * (1.0f / b - 1.0f / a), 0.0f);
}

SHARED_END

#endif
