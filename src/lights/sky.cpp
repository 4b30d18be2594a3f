#include "lights/sky.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/color.h"
#include "core/directions.h"

namespace nephroid {
namespace {

constexpr uvec2 kEvenSkySize{64, 32};

// Cells of a map: columns and rows from `low` up to `high`, which is not of it.
struct Region {
  uvec2 low{0}, high{0};
};

// Latitude (radians) of the upper edge of a row.
float latitudeAbove(const SkyMap& sky, uint32_t row) {
  return kPi * (0.5f - float(row) / float(sky.size.y));
}

// The light of some cells: how bright they are, and that with their directions.
struct Sum {
  double flux = 0;
  glm::dvec3 toward{0};

  void add(double amount, const glm::dvec3& direction) {
    flux += amount;
    toward += amount * direction;
  }
  // Flux times the mean square of the distance from the mean direction.
  double spread() const { return flux > 0 ? std::max(flux - dot(toward, toward) / flux, 0.0) : 0; }
};

Sum operator+(const Sum& a, const Sum& b) {
  return {a.flux + b.flux, a.toward + b.toward};
}

Sum operator-(const Sum& a, const Sum& b) {
  return {a.flux - b.flux, a.toward - b.toward};
}

// Cells whose luminance is from `low` up to `high`, within a region that they fill.
struct Part {
  Region region;
  float low = 0, high = 0;
  Sum sum{};
  double spread = 0;  // 0 where it is not to be cut
};

class Cutter {
 public:
  explicit Cutter(const SkyMap& map) : sky_(map) {
    for (uint32_t x = 0; x < map.size.x; ++x) columns_.push_back(towardSky({middleOf(x, map.size.x), 0.5f}));
    for (uint32_t y = 0; y < map.size.y; ++y) rows_.push_back(towardSky({0.5f, middleOf(y, map.size.y)}));
    const Region all{uvec2(0), map.size};
    double flux = 0;
    forEach({all, 0, kNoLimit}, [&](uvec2, vec3 illuminance) { flux += double(luminanceOf(illuminance)); });
    const float mean = float(flux / (4 * double(kPi)));
    float low = 0;
    for (float high = kBrighter * mean; high < kBrightest * mean; high *= kBrighter) {
      add({all, low, high});
      low = high;
    }
    add({all, low, kNoLimit});
  }

  void cut(uint32_t most, double spread) {
    while (parts_.size() < most && spread_ > spread * flux_) {
      const auto widest = std::ranges::max_element(parts_, {}, &Part::spread);
      if (widest == parts_.end() || widest->spread == 0) return;
      const auto [first, second] = halves(*widest);
      spread_ -= widest->spread;
      flux_ -= widest->sum.flux;
      parts_.erase(widest);
      add(first);
      add(second);
    }
  }

  std::vector<SkyPart> found() const {
    std::vector<SkyPart> found;
    for (const Part& part : parts_) found.push_back(describe(part));
    return found;
  }

 private:
  static constexpr double kNoSpread = 1e-9;  // of directions that are one
  static constexpr float kNoLimit = std::numeric_limits<float>::infinity();
  // Over the mean: cells that are this much brighter than others are not in one part with them, so that a
  // sun keeps its place and its size.
  static constexpr float kBrighter = 32, kBrightest = 1e5f;

  static float middleOf(uint32_t i, uint32_t count) { return (float(i) + 0.5f) / float(count); }

  // use(cell, lux)
  template <class Use>
  void forEach(const Part& part, const Use& use) const {
    for (uint32_t y = part.region.low.y; y < part.region.high.y; ++y) {
      const float angle = skyCellAngle(sky_, y);
      for (uint32_t x = part.region.low.x; x < part.region.high.x; ++x) {
        const vec3 luminance = sky_.luminance[std::size_t{y} * sky_.size.x + x];
        const float brightness = luminanceOf(luminance);
        if (brightness >= part.low && brightness < part.high) use(uvec2(x, y), luminance * angle);
      }
    }
  }

  // towardSky of its middle.
  vec3 toward(uvec2 cell) const {
    const float across = -rows_[cell.y].z;  // the cosine of the latitude
    return {across * columns_[cell.x].x, rows_[cell.y].y, across * columns_[cell.x].z};
  }

  // Keeps what shines.
  void add(Part part) {
    Region lit{sky_.size, uvec2(0)};
    forEach(part, [&](uvec2 cell, vec3 illuminance) {
      const double flux = double(luminanceOf(illuminance));
      if (!(flux > 0)) return;
      part.sum.add(flux, glm::dvec3(toward(cell)));
      lit.low = min(lit.low, cell);
      lit.high = max(lit.high, cell + 1u);
    });
    if (!(part.sum.flux > 0)) return;
    part.region = lit;
    const double spread = part.sum.spread();
    const bool isOne = lit.high - lit.low == uvec2(1) || spread <= kNoSpread * part.sum.flux;
    part.spread = isOne ? 0 : spread;
    spread_ += part.spread;
    flux_ += part.sum.flux;
    parts_.push_back(part);
  }

  // The two whose spreads are least, of all cuts between columns or rows.
  std::pair<Part, Part> halves(const Part& part) const {
    const Region& region = part.region;
    const uvec2 size = region.high - region.low;
    std::vector<Sum> lines[2] = {std::vector<Sum>(size.x), std::vector<Sum>(size.y)};
    forEach(part, [&](uvec2 cell, vec3 illuminance) {
      for (int axis = 0; axis < 2; ++axis)
        lines[axis][cell[axis] - region.low[axis]].add(double(luminanceOf(illuminance)),
                                                       glm::dvec3(toward(cell)));
    });
    double least = std::numeric_limits<double>::infinity();
    std::pair<Part, Part> best;
    for (int axis = 0; axis < 2; ++axis) {
      Sum before;
      for (uint32_t edge = 1; edge < size[axis]; ++edge) {
        before = before + lines[axis][edge - 1];
        const double spread = before.spread() + (part.sum - before).spread();
        if (!(spread < least)) continue;
        least = spread;
        best.first = best.second = {region, part.low, part.high};
        best.first.region.high[axis] = best.second.region.low[axis] = region.low[axis] + edge;
      }
    }
    return best;
  }

  SkyPart describe(const Part& part) const {
    SkyPart found;
    const vec3 mean = normalize(vec3(part.sum.toward));
    const mat3 frame = frameAround(mean);
    glm::dvec3 squares(0);  // xx, xy, yy along the frame's first two axes
    forEach(part, [&](uvec2 cell, vec3 illuminance) {
      found.illuminance += illuminance;
      const vec3 direction = toward(cell);
      const double flux = double(luminanceOf(illuminance)) / part.sum.flux;
      const auto addAlong = [&](vec2 off) {
        squares += flux * glm::dvec3(off.x * off.x, off.x * off.y, off.y * off.y);
      };
      const vec3 off = direction / std::max(dot(direction, mean), kLeastCosine);
      addAlong({dot(off, frame[0]), dot(off, frame[1])});
      // And within the cell, along the circle of latitude and across it.
      const float step = kPi / float(sky_.size.y) * std::sqrt(1 / 12.0f);
      const float around = 2 * kPi / float(sky_.size.x) * std::sqrt(1 / 12.0f);
      const vec3 east(-direction.z, 0, direction.x), north = cross(direction, east);
      addAlong(around * vec2(dot(east, frame[0]), dot(east, frame[1])));
      addAlong(step / std::max(length(east), 1e-6f) * vec2(dot(north, frame[0]), dot(north, frame[1])));
    });
    found.direction = -mean;
    // Along the axes of the ellipse that has these squares.
    const double half = 0.5 * (squares.x + squares.z);
    const double rest = std::hypot(0.5 * (squares.x - squares.z), squares.y);
    const double turn = 0.5 * std::atan2(2 * squares.y, squares.x - squares.z);
    const vec2 along(float(std::cos(turn)), float(std::sin(turn)));
    // The light travels the other way.
    found.spread[0] = -float(std::sqrt(half + rest)) * (along.x * frame[0] + along.y * frame[1]);
    found.spread[1] =
        -float(std::sqrt(std::max(half - rest, 0.0))) * (along.x * frame[1] - along.y * frame[0]);
    return found;
  }

  static constexpr float kLeastCosine = 0.3f;  // of the widest parts

  const SkyMap& sky_;
  std::vector<vec3> columns_, rows_;  // towardSky where longitude or latitude is 0
  std::vector<Part> parts_;
  double spread_ = 0, flux_ = 0;  // of all parts
};

}  // namespace

SkyMap evenSky() {
  return {"even sky", kEvenSkySize, std::vector<vec3>(std::size_t{kEvenSkySize.x} * kEvenSkySize.y, vec3(1))};
}

vec3 towardSky(vec2 at) {
  const float longitude = 2 * kPi * (at.x - 0.5f), latitude = kPi * (0.5f - at.y);
  return {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
          -std::cos(longitude) * std::cos(latitude)};
}

float skyCellAngle(const SkyMap& sky, uint32_t row) {
  return 2 * kPi / float(sky.size.x) *
         (std::sin(latitudeAbove(sky, row)) - std::sin(latitudeAbove(sky, row + 1)));
}

mat3 skyTurned(float degrees) {
  return glm::mat3_cast(glm::angleAxis(glm::radians(degrees), vec3(0, 1, 0)));
}

std::vector<SkyPart> skyParts(const SkyMap& sky, uint32_t most, double spread) {
  Cutter cutter(sky);
  cutter.cut(std::max(most, 2u), spread);
  return cutter.found();
}

}  // namespace nephroid
