// Divides a beam's footprint among the texels of a grid, on the processor.
#pragma once

#include <algorithm>
#include <cmath>

#include "beams/footprint.h"

namespace nephroid {

// Calls add(index, part) for each texel: its index is row * size.x + column, and `part` is the part (0..1) of
// the footprint in it. The parts add up to 1 where the whole footprint is on the grid.
template <class Add>
class FootprintSharer {
 public:
  FootprintSharer(uvec2 size, const Add& addTo) : resolution_(size), add_(addTo) {}

  // Corners in texels.
  void share(vec2 a, vec2 b, vec2 c) const {
    const vec2 lower = floor(min(min(a, b), c));
    const vec2 upper = floor(max(max(a, b), c));
    if (lower == upper) return addAt(lower, 1);
    vec2 localA = a, localB = b, localC = c, base;
    centerFootprint(localA, localB, localC, base);
    if (isSliver(localA, localB, localC)) return shareSliver(a, b, c);
    const double area = 0.5 * std::abs(doubledArea(localA, localB, localC));
    const vec3 slopes = sideSlopes(localA, localB, localC);
    const vec2 last = min(upper, vec2(resolution_) - 1.0f);
    for (float y = std::max(lower.y, 0.0f); y <= last.y; ++y) {
      const TriangleRow row = triangleInRow(localA, localB, localC, slopes, y - base.y);
      const float lastX = std::min(std::floor(row.last) + base.x, last.x);
      for (float x = std::max(std::floor(row.first) + base.x, 0.0f); x <= lastX; ++x)
        addAt(vec2(x, y), triangleCoverage(row, x - base.x) / area);
    }
  }

  void addAt(vec2 texel, double part) const {
    const float x = std::floor(texel.x), y = std::floor(texel.y);
    if (x < 0 || y < 0 || x >= float(resolution_.x) || y >= float(resolution_.y)) return;
    add_(std::size_t(y) * resolution_.x + std::size_t(x), part);
  }

 private:
  void shareSliver(vec2 a, vec2 b, vec2 c) const {
    const float peak = sortSliver(a, b, c);
    const vec2 along = c - a;
    const int steps = sliverSteps(a, c);
    double before = 0;
    for (int i = 0; i < steps; ++i) {
      const double after = tentBefore(float(i + 1) / float(steps), peak);
      addAt(a + (float(i) + 0.5f) / float(steps) * along, after - before);
      before = after;
    }
  }

  uvec2 resolution_;
  const Add& add_;
};

}  // namespace nephroid
