#include "techniques/adaptive_beams/tile_deposit.h"

#include <algorithm>
#include <cmath>

#include "beams/footprint.h"

namespace nephroid {
namespace {

// Texels that a beam is wide: corners are not known better, and a thinner one is a line.
constexpr double kThinnest = 2e-4;
// Texels of doubled area below which a beam has one density.
constexpr double kSmallest = 1;

glm::dvec2 exactly(vec2 v) {
  return {double(v.x), double(v.y)};
}

// The integral of max(t - x, 0) over x from `low` to `high`.
double coveredBefore(double t, double low, double high) {
  if (t <= low) return 0;
  if (t >= high) return (high - low) * (t - 0.5 * (low + high));
  return 0.5 * (t - low) * (t - low);
}

}  // namespace

void TileDeposit::begin(uvec2 size) {
  size_ = size;
  stride_ = size.x + 1;
  differences_.assign(stride_ * size.y, Sums{});
}

void TileDeposit::add(vec2 a, vec2 b, vec2 c, vec3 density, vec3 flux) {
  const vec2 lower = floor(min(min(a, b), c)), upper = floor(max(max(a, b), c));
  if (upper.x < 0 || upper.y < 0 || lower.x >= float(size_.x) || lower.y >= float(size_.y)) return;
  if (lower == upper) return put(int(lower.x), int(lower.y), flux);
  const glm::dvec2 p = exactly(a), q = exactly(b), r = exactly(c);
  const glm::dvec2 toB = q - p, toC = r - p;
  const double doubled = toB.x * toC.y - toB.y * toC.x;
  const double longest = std::max({length(toB), length(toC), length(r - q)});
  if (std::abs(doubled) < kThinnest * longest) return addLine(a, b, c, flux);
  Slope slope;
  if (density != vec3(1) && std::abs(doubled) > kSmallest) {
    const double rise = double(density.y - density.x), riseToC = double(density.z - density.x);
    slope.x = (rise * toC.y - riseToC * toB.y) / doubled;
    slope.y = (riseToC * toB.x - rise * toC.x) / doubled;
    slope.base = double(density.x) - slope.x * (p.x - 0.5) - slope.y * (p.y - 0.5);
  }
  // Sides of a triangle that turns left add up to what it covers; of another, to its negative.
  const double scale = -2 / doubled;
  const std::array<double, 3> light{scale * double(flux.x), scale * double(flux.y), scale * double(flux.z)};
  addSide(p, q, slope, light);
  addSide(q, r, slope, light);
  addSide(r, p, slope, light);
}

void TileDeposit::addSide(glm::dvec2 from, glm::dvec2 to, const Slope& slope,
                          const std::array<double, 3>& flux) {
  if (from.y == to.y) return;
  const double sign = from.y < to.y ? 1 : -1;
  if (from.y > to.y) std::swap(from, to);
  const double alongX = (to.x - from.x) / (to.y - from.y);
  const double first = std::max(from.y, 0.0), last = std::min(to.y, double(size_.y));
  if (first >= last) return;
  const double width = double(size_.x), rise = sign * slope.x;
  Sums light{0, 0, 0, flux[0] * rise, flux[1] * rise, flux[2] * rise};
  double y = first, x = from.x + (first - from.y) * alongX;
  Sums* row = differences_.data() + std::size_t(first) * stride_;
  for (double nextRow = double(int(first) + 1); y < last; nextRow += 1, row += stride_) {
    const double nextY = std::min(nextRow, last);
    const double nextX = nextY == to.y ? to.x : from.x + (nextY - from.y) * alongX;
    const double atRow = sign * (slope.base + slope.y * (nextRow - 1)), height = nextY - y;
    for (std::size_t c = 0; c < 3; ++c) light[c] = flux[c] * atRow;
    const double low = std::min(x, nextX), high = std::max(x, nextX);
    const int column = int(std::clamp(low, 0.0, width));
    if (high <= double(column)) {
      addAt(row[column], height, light);
    } else if (low >= 0 && high <= double(column + 1) && low < width) {
      const double outside = (0.5 * (low + high) - double(column)) * height;
      addAt(row[column], height - outside, light);
      addAt(row[column + 1], outside, light);
    } else if (low < width) {
      addLongSide(row, low, high, height, light);
    }
    y = nextY;
    x = nextX;
  }
}

// What lies to the right of a side that is `height` high in the row, between the columns x0 and x1.
void TileDeposit::addLongSide(Sums* row, double x0, double x1, double height, const Sums& light) const {
  const std::size_t first = std::size_t(std::max(x0, 0.0));
  const double perWidth = height / (x1 - x0);
  double before = coveredBefore(double(first), x0, x1), covered = 0;
  for (std::size_t column = first; column <= size_.x; ++column) {
    const double after = coveredBefore(double(column + 1), x0, x1);
    const double now = (after - before) * perWidth;
    addAt(row[column], now - covered, light);
    if (double(column) >= x1) return;
    before = after;
    covered = now;
  }
}

void TileDeposit::put(int x, int y, vec3 flux) {
  Sums* at = differences_.data() + std::size_t(y) * stride_ + std::size_t(x);
  for (std::size_t i = 0; i < 3; ++i) {
    at[0][i] += double(flux[int(i)]);
    at[1][i] -= double(flux[int(i)]);
  }
}

// A beam without width, along its longest side, as far as that is on the tile.
void TileDeposit::addLine(vec2 a, vec2 b, vec2 c, vec3 flux) {
  const float peak = sortSliver(a, b, c);
  const vec2 along = c - a, size(size_);
  float first = 0, last = 1;
  for (int axis = 0; axis < 2; ++axis) {
    if (along[axis] == 0) continue;
    const float from = -a[axis] / along[axis], to = (size[axis] - a[axis]) / along[axis];
    first = std::max(first, std::min(from, to));
    last = std::min(last, std::max(from, to));
  }
  const float steps = float(sliverSteps(a, c));
  const int end = int(std::ceil(std::min(last * steps + 1, steps)));
  for (int i = int(std::max(first * steps - 1, 0.0f)); i < end; ++i) {
    const vec2 at = floor(a + (float(i) + 0.5f) / steps * along);
    if (at.x < 0 || at.y < 0 || at.x >= size.x || at.y >= size.y) continue;
    put(int(at.x), int(at.y),
        flux * (tentBefore(float(i + 1) / steps, peak) - tentBefore(float(i) / steps, peak)));
  }
}

void TileDeposit::addTo(std::array<float*, 3> planes) const {
  for (std::size_t y = 0; y < size_.y; ++y) {
    Sums sum{};
    const Sums* row = differences_.data() + y * stride_;
    for (std::size_t x = 0; x < size_.x; ++x) {
      for (std::size_t i = 0; i < kSums; ++i) sum[i] += row[x][i];
      for (std::size_t c = 0; c < 3; ++c)
        planes[c][y * size_.x + x] += std::max(float(sum[c] + double(x) * sum[3 + c]), 0.0f);
    }
  }
}

}  // namespace nephroid
