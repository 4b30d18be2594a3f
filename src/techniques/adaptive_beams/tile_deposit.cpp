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
  const Light light{scale * double(flux.x), scale * double(flux.y), scale * double(flux.z)};
  addSide(p, q, slope, light);
  addSide(q, r, slope, light);
  addSide(r, p, slope, light);
}

void TileDeposit::addSide(glm::dvec2 from, glm::dvec2 to, const Slope& slope, const Light& flux) {
  if (from.y == to.y) return;
  Side side{from, to, slope, flux};
  if (from.y > to.y) {
    std::swap(side.from, side.to);
    for (double& color : side.flux) color = -color;
  }
  side.alongX = (side.to.x - side.from.x) / (side.to.y - side.from.y);
  const double first = std::max(side.from.y, 0.0), last = std::min(side.to.y, double(size_.y));
  if (first >= last) return;
  const double width = double(size_.x);
  // Where the side comes into the tile, and where it leaves it.
  const auto rowWhere = [&](double x) {
    return std::clamp(side.from.y + (x - side.from.x) / side.alongX, first, last);
  };
  if (side.alongX > 0) {
    const double in = side.from.x < 0 ? rowWhere(0) : first;
    addOnLeft(side, first, in);
    addInside(side, in, side.to.x > width ? rowWhere(width) : last);
  } else if (side.alongX < 0) {
    const double out = side.to.x < 0 ? rowWhere(0) : last;
    addInside(side, side.from.x > width ? rowWhere(width) : first, out);
    addOnLeft(side, out, last);
  } else if (side.from.x < 0) {
    addOnLeft(side, first, last);
  } else if (side.from.x < width) {
    addInside(side, first, last);
  }
}

// Of a fully covered texel of the row.
inline TileDeposit::Sums TileDeposit::lightOf(const Side& side, double row) {
  const double atRow = side.slope.base + side.slope.y * row, rise = side.slope.x;
  const Light& flux = side.flux;
  return {Pair{flux[0] * atRow, flux[1] * atRow}, Pair{flux[2] * atRow, flux[0] * rise},
          Pair{flux[1] * rise, flux[2] * rise}};
}

// A part of a side that is to the left of the tile.
void TileDeposit::addOnLeft(const Side& side, double first, double last) {
  std::size_t row = std::size_t(first);
  for (double y = first; y < last; ++row) {
    const double next = std::min(double(row + 1), last);
    addAt(differences_[row * stride_], next - y, lightOf(side, double(row)));
    y = next;
  }
}

// A part of a side that is in the tile.
void TileDeposit::addInside(const Side& side, double first, double last) {
  const double width = double(size_.x);
  const auto columnAt = [&](double y) {
    return std::clamp(side.from.x + (y - side.from.y) * side.alongX, 0.0, width);
  };
  std::size_t row = std::size_t(first);
  double x = columnAt(first);
  for (double y = first; y < last; ++row) {
    const double nextY = std::min(double(row + 1), last);
    const double nextX = nextY == side.to.y ? std::clamp(side.to.x, 0.0, width) : columnAt(nextY);
    const double low = std::min(x, nextX), high = std::max(x, nextX), height = nextY - y;
    const std::size_t column = std::min(std::size_t(low), std::size_t(size_.x - 1));
    Sums* sums = differences_.data() + row * stride_;
    const Sums light = lightOf(side, double(row));
    if (high <= double(column + 1)) {
      const double outside = (0.5 * (low + high) - double(column)) * height;
      addAt(sums[column], height - outside, light);
      addAt(sums[column + 1], outside, light);
    } else {
      addLongSide(sums, low, high, height, light);
    }
    y = nextY;
    x = nextX;
  }
}

// What lies to the right of a side that is `height` high in the row, between the columns x0 and x1.
void TileDeposit::addLongSide(Sums* row, double x0, double x1, double height, const Sums& light) const {
  const double perWidth = height / (x1 - x0);
  const std::size_t first = std::size_t(x0), last = std::min(std::size_t(x1), std::size_t(size_.x) - 1);
  double before = 0;  // of the texel to the left: the part that is to the right of the side
  for (std::size_t column = first; column <= last; ++column) {
    const double right = double(column + 1);
    const double from = std::max(x0, right - 1), to = std::min(x1, right);
    // Up to `from` all of the texel is to the right of the side.
    const double covered = ((from - x0) + (to - from) * (right - 0.5 * (from + to))) * perWidth;
    addAt(row[column], covered - before, light);
    before = covered;
  }
  addAt(row[last + 1], height - before, light);
}

void TileDeposit::put(int x, int y, vec3 flux) {
  Sums* at = differences_.data() + std::size_t(y) * stride_ + std::size_t(x);
  const Sums light{Pair{double(flux.x), double(flux.y)}, Pair{double(flux.z), 0}, Pair{0, 0}};
  addAt(at[0], 1, light);
  addAt(at[1], -1, light);
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
    const std::size_t first = y * size_.x;
    for (std::size_t x = 0; x < size_.x; ++x) {
      addAt(sum, 1, row[x]);
      const double column = double(x);
      const double light[3] = {sum[0][0] + column * sum[1][1], sum[0][1] + column * sum[2][0],
                               sum[1][0] + column * sum[2][1]};
      for (std::size_t c = 0; c < 3; ++c) planes[c][first + x] += std::max(float(light[c]), 0.0f);
    }
  }
}

}  // namespace nephroid
