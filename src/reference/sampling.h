// Makes points, directions and distances from random numbers in [0, 1).
#pragma once

#include <cmath>
#include <limits>

#include "core/random.h"
#include "core/shared_language.h"

namespace nephroid {

inline constexpr float kPi = 3.14159265358979f;

// A frame of three orthogonal unit vectors, of which `axis` is the third (Duff et al. 2017).
inline mat3 frameAround(vec3 axis) {
  const float sign = std::copysign(1.0f, axis.z);
  const float a = -1 / (sign + axis.z);
  const float b = axis.x * axis.y * a;
  return {vec3(1 + sign * axis.x * axis.x * a, sign * b, -sign * axis.x),
          vec3(b, sign + axis.y * axis.y * a, -axis.y), axis};
}

// A uniform point in the unit disk. Neighboring numbers give neighboring points (Shirley and Chiu 1997).
inline vec2 sampleDisk(vec2 u) {
  const vec2 p = 2.0f * u - 1.0f;
  if (p.x == 0 && p.y == 0) return vec2(0);
  if (std::abs(p.x) > std::abs(p.y)) {
    const float turn = kPi / 4 * (p.y / p.x);
    return p.x * vec2(std::cos(turn), std::sin(turn));
  }
  const float turn = kPi / 2 - kPi / 4 * (p.x / p.y);
  return p.y * vec2(std::cos(turn), std::sin(turn));
}

// A uniform direction within a cone about +z. `width`: 1 - cosine of its half angle; 2 for all directions.
// Neighboring numbers give neighboring directions (Lambert's azimuthal map of the disk).
inline vec3 sampleCone(vec2 u, float width) {
  const vec2 p = sampleDisk(u);
  const float drop = width * dot(p, p);  // 1 - cosine
  return {p * std::sqrt(std::max(width * (2 - drop), 0.0f)), 1 - drop};
}

// The density (1/sr) of the directions of sampleCone.
inline float coneDensity(float width) {
  return 1 / (2 * kPi * width);
}

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

// The point at `u` in [0, 1) of a curve that fills the unit square (Morton 1966). Evenly spread numbers give
// evenly spread points, and neighboring numbers give points near each other.
inline vec2 pointOnCurve(double u) {
  const auto everyOtherBit = [](uint64_t x) {
    x &= 0x5555555555555555ULL;
    x = (x | x >> 1) & 0x3333333333333333ULL;
    x = (x | x >> 2) & 0x0f0f0f0f0f0f0f0fULL;
    x = (x | x >> 4) & 0x00ff00ff00ff00ffULL;
    x = (x | x >> 8) & 0x0000ffff0000ffffULL;
    return static_cast<float>((x | x >> 16) & 0xffffffULL) * 0x1p-24f;
  };
  const auto bits = static_cast<uint64_t>(u * 0x1p48);
  return {everyOtherBit(bits), everyOtherBit(bits >> 1)};
}

}  // namespace nephroid
