// A beam's light shared out among the texels of a tile: exact coverage, with the density between its corners.
// Native loops over rows of one color each, which compilers turn into SIMD.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "beams/footprint.h"
#include "techniques/adaptive_beams/landed_light_data.h"

namespace nephroid {

class TileDeposit {
 public:
  // Red, green and blue texels of a tile of `size`, rows one after the other.
  TileDeposit(std::array<float*, 3> planes, uvec2 size) : planes_(planes), stride_(size.x), size_(size) {}

  // Corners in texels of the tile; density at the corners over its mean; lm, or any unit to be shared out.
  void add(vec2 a, vec2 b, vec2 c, vec3 density, vec3 flux) const {
    const vec2 lower = floor(min(min(a, b), c)), upper = floor(max(max(a, b), c));
    if (upper.x < 0 || upper.y < 0 || lower.x >= size_.x || lower.y >= size_.y) return;
    if (lower == upper) return put(int(lower.x), int(lower.y), flux);
    if (isSliver(a, b, c)) return addSliver(a, b, c, flux);
    vec2 localA = a, localB = b, localC = c, base;
    centerFootprint(localA, localB, localC, base);
    const float inverseArea = 2.0f / std::abs(doubledArea(localA, localB, localC));
    const Slope slope = slopeOf(a, b, c, density);
    const vec3 slopes = sideSlopes(localA, localB, localC);
    const float lastY = std::min(upper.y, size_.y - 1);
    for (float y = std::max(lower.y, 0.0f); y <= lastY; ++y) {
      const TriangleRow row = triangleInRow(localA, localB, localC, slopes, y - base.y);
      const float first = std::max(std::floor(row.first) + base.x, 0.0f);
      const float last = std::min(std::floor(row.last) + base.x, size_.x - 1);
      for (float x = first; x <= last; x += kRun) {
        Run run;
        run.first = x;
        run.base = base.x;
        run.count = std::size_t(std::min(last - x + 1, float(kRun)));
        weigh(run, row, slope, y);
        addRun(run, std::size_t(y), flux * inverseArea);
      }
    }
  }

 private:
  struct Slope {
    float base = 1;
    vec2 gradient{0};
  };
  static Slope slopeOf(vec2 a, vec2 b, vec2 c, vec3 density) {
    Slope slope;
    const float doubled = doubledArea(a, b, c);
    if (density == vec3(1) || std::abs(doubled) < 1) return slope;
    const float toB = density.y - density.x, toC = density.z - density.x;
    slope.gradient =
        vec2(toB * (c.y - a.y) - toC * (b.y - a.y), toC * (b.x - a.x) - toB * (c.x - a.x)) / doubled;
    slope.base = density.x - dot(slope.gradient, a);
    return slope;
  }

  static constexpr int kRun = 32;
  // Neighbors in a row.
  struct Run {
    float first;  // texel of the tile
    float base;   // texel that is column 0 of the centered footprint
    std::size_t count;
    float weight[kRun];
  };

  // Adds a side's sideCoverage, texel by texel.
  static void addSide(Run& run, vec3 side, float perWidth) {
    const float from = side.x, to = side.y, down = side.z, begin = run.first - run.base;
    if (down == 0) return;
    const bool isUpright = from == to;
    const float widthScale = isUpright ? 0.0f : perWidth, uprightScale = isUpright ? down : 0.0f;
    for (std::size_t i = 0; i < run.count; ++i) {
      const float column = begin + float(int(i)), right = column + 1;
      const float x0 = std::min(std::max(from, column), right), x1 = std::min(std::max(to, column), right);
      const float mean = 0.5f * (x0 + x1) - column;
      run.weight[i] += ((x1 - x0) * mean + (std::max(to, right) - std::max(from, right))) * widthScale +
                       mean * uprightScale;
    }
  }

  static void weigh(Run& run, const TriangleRow& row, const Slope& slope, float y) {
    std::fill_n(run.weight, run.count, 0.0f);
    addSide(run, row.ab, row.perWidth.x);
    addSide(run, row.bc, row.perWidth.y);
    addSide(run, row.ca, row.perWidth.z);
    const float begin = slope.base + slope.gradient.x * (run.first + 0.5f) + slope.gradient.y * (y + 0.5f);
    for (std::size_t i = 0; i < run.count; ++i)
      run.weight[i] = std::abs(run.weight[i]) * std::max(begin + slope.gradient.x * float(int(i)), 0.0f);
  }

  void addRun(const Run& run, std::size_t y, vec3 flux) const {
    for (int c = 0; c < 3; ++c) {
      float* to = planes_[std::size_t(c)] + y * stride_ + std::size_t(run.first);
      const float part = flux[c];
      for (std::size_t i = 0; i < run.count; ++i) to[i] += part * run.weight[i];
    }
  }

  void put(int x, int y, vec3 flux) const {
    for (int c = 0; c < 3; ++c) planes_[std::size_t(c)][std::size_t(y) * stride_ + std::size_t(x)] += flux[c];
  }

  // Along its longest side, as far as that is on the tile.
  void addSliver(vec2 a, vec2 b, vec2 c, vec3 flux) const {
    const float peak = sortSliver(a, b, c);
    const vec2 along = c - a;
    float first = 0, last = 1;
    for (int axis = 0; axis < 2; ++axis) {
      if (along[axis] == 0) continue;
      const float from = -a[axis] / along[axis], to = (size_[axis] - a[axis]) / along[axis];
      first = std::max(first, std::min(from, to));
      last = std::min(last, std::max(from, to));
    }
    const float steps = float(sliverSteps(a, c));
    const int end = int(std::ceil(std::min(last * steps + 1, steps)));
    for (int i = int(std::max(first * steps - 1, 0.0f)); i < end; ++i) {
      const vec2 at = floor(a + (float(i) + 0.5f) / steps * along);
      if (at.x < 0 || at.y < 0 || at.x >= size_.x || at.y >= size_.y) continue;
      put(int(at.x), int(at.y),
          flux * (tentBefore(float(i + 1) / steps, peak) - tentBefore(float(i) / steps, peak)));
    }
  }

  std::array<float*, 3> planes_;
  std::size_t stride_;
  vec2 size_;
};

// Adds to a plane of a tile what a coarser one has there, whose texel `offset` (without its border) is the
// tile's first: at quarters between the coarse texels' middles.
inline void addCoarser(std::span<const float> coarse, vec2 offset, std::span<float> tile) {
  const std::size_t firstColumn = std::size_t(offset.x), firstRow = std::size_t(offset.y);
  for (std::size_t y = 0; y < kTileStride; ++y) {
    const std::size_t row = firstRow + y / 2;  // the upper of the two
    const float lower = y % 2 == 0 ? 0.25f : 0.75f;
    float between[kTileTexels / 2 + 2];
    for (std::size_t x = 0; x < kTileTexels / 2 + 2; ++x) {
      const float* at = coarse.data() + row * kTileStride + firstColumn + x;
      between[x] = (1 - lower) * at[0] + lower * at[kTileStride];
    }
    for (std::size_t x = 0; x < kTileStride; ++x) {
      const float right = x % 2 == 0 ? 0.25f : 0.75f;
      tile[y * kTileStride + x] += (1 - right) * between[x / 2] + right * between[x / 2 + 1];
    }
  }
}

}  // namespace nephroid
