// Places on lamps that are looked at together.
#pragma once

#include "core/shared_language.h"

namespace nephroid {

// Point `i` of a sequence in the unit square, each 2^n of which, from a multiple of it on, are spread evenly:
// one in each of 2^n boxes of any shape (Sobol 1967, the first two dimensions). `turn`: exchanges halves of
// the square, halves of these, and so on, which keeps them as evenly spread.
inline vec2 evenPlace(uint32_t i, uvec2 turn) {
  uint32_t x = 0, y = 0;
  for (uint32_t bit = 1u << 31, other = 1u << 31; i != 0; i >>= 1, bit >>= 1, other ^= other >> 1)
    if (i & 1u) {
      x ^= bit;
      y ^= other;
    }
  x ^= turn.x;
  y ^= turn.y;
  return vec2(float(x >> 8), float(y >> 8)) * 0x1p-24f;
}

// Two numbers for each pixel and lamp, unlike those of its neighbors (Jarzynski and Olano 2020, pcg3d).
inline uvec2 turnAt(uvec2 pixel, uint32_t lamp) {
  uvec3 v = uvec3(pixel, lamp) * 1664525u + 1013904223u;
  for (int round = 0; round < 2; ++round) {
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    if (round == 0) v ^= v >> 16u;
  }
  return {v.x, v.y};
}

}  // namespace nephroid
