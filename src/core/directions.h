// Makes points and directions from numbers in [0, 1).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

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
