// Makes distances from random numbers in [0, 1), and the random numbers of an item.
#pragma once

#include <cmath>
#include <limits>

#include "core/directions.h"
#include "core/random.h"
#include "core/shared_language.h"

namespace nephroid {

// A distance along a ray of `length` (m, may be infinite). Its density falls like light in air with this
// extinction (1/m); it is uniform where the extinction is 0.
struct DistanceSample {
  float distance = 0;  // m
  float density = 0;   // 1/m
};

inline DistanceSample sampleExtinction(float u, float extinction, float length) {
  const float depth = extinction * length;
  if (depth < 1e-4f) return {u * length, 1 / length};
  const float scattered = -std::expm1(-depth);
  // `u` may be rounded to 1, which would give an infinite distance.
  const float part = std::min(u, 1 - 0x1p-24f);
  const float distance = std::min(-std::log1p(-part * scattered) / extinction, length);
  return {distance, extinction * std::exp(-extinction * distance) / scattered};
}

// A distance along a ray whose density is proportional to the inverse square of the distance to `point`
// (Kulla and Fajardo 2012). It uses the angle seen from `point`, counted from the ray's origin. A difference
// of two angles would not be precise where the ray ends before a point that is nearly on its line.
inline DistanceSample sampleEquiangular(float u, vec3 origin, vec3 direction, float length, vec3 point) {
  const float nearest = dot(point - origin, direction);  // m along the ray
  const float height = std::max(glm::length(point - origin - nearest * direction), 1e-6f);
  const float squared = height * height + nearest * nearest;  // m2 from the origin to the point
  const float span = std::isinf(length) ? std::atan2(height, -nearest)
                                        : std::atan2(height * length, squared - nearest * length);
  const float sine = std::sin(u * span), cosine = std::cos(u * span);
  const float reach = squared * sine / std::max(height * cosine + nearest * sine, 1e-30f);
  const float distance = glm::clamp(reach, 0.0f, std::min(length, std::numeric_limits<float>::max()));
  const float beyond = distance - nearest;
  return {distance, height / (span * (height * height + beyond * beyond))};
}

// The random numbers of one item of a pass. They are the same in any thread, and independent of those of
// other items.
inline Random randomOf(uint64_t seed, uint64_t pass, uint64_t item) {
  uint64_t mixed = 0;
  for (const uint64_t word : {seed, pass, item}) {  // splitmix64 (Steele et al. 2014)
    mixed = (mixed ^ word) + 0x9e3779b97f4a7c15ULL;
    mixed = (mixed ^ (mixed >> 30)) * 0xbf58476d1ce4e5b9ULL;
    mixed = (mixed ^ (mixed >> 27)) * 0x94d049bb133111ebULL;
    mixed ^= mixed >> 31;
  }
  return Random(mixed, item);
}

}  // namespace nephroid
