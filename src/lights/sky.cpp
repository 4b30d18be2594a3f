#include "lights/sky.h"

#include <algorithm>
#include <cmath>

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

class Cutter {
 public:
  explicit Cutter(const SkyMap& map) : sky_(map) {}

  void cut(const Region& region, uint32_t parts) {
    if (parts == 0) return;
    if (parts > 1 && isDivisible(region)) {
      const auto [first, second, share] = halves(region);
      const uint32_t fewest = share > 0 ? 1 : 0, most = share < 1 ? parts - 1 : parts;
      const uint32_t ofFirst =
          std::clamp(static_cast<uint32_t>(std::lround(share * double(parts))), fewest, most);
      cut(first, ofFirst);
      cut(second, parts - ofFirst);
      return;
    }
    SkyPart part;
    vec3 mean(0);
    forEach(region, [&](uint32_t x, uint32_t y) {
      const vec3 illuminance = sky_.luminance[std::size_t{y} * sky_.size.x + x] * skyCellAngle(sky_, y);
      part.illuminance += illuminance;
      mean += luminanceOf(illuminance) * towardSky((vec2(float(x), float(y)) + 0.5f) / vec2(sky_.size));
    });
    if (part.illuminance == vec3(0)) return;
    part.direction = -normalize(mean);
    found.push_back(part);
  }

  std::vector<SkyPart> found;

 private:
  template <class Use>
  static void forEach(const Region& region, const Use& use) {
    for (uint32_t y = region.low.y; y < region.high.y; ++y)
      for (uint32_t x = region.low.x; x < region.high.x; ++x) use(x, y);
  }

  static bool isDivisible(const Region& region) {
    return region.high.x - region.low.x > 1 || region.high.y - region.low.y > 1;
  }

  struct Halves {
    Region first, second;
    double share = 0;  // of the flux, in the first
  };

  // Across its longer side, where it is longest.
  Halves halves(const Region& region) const {
    const float top = latitudeAbove(sky_, region.low.y), bottom = latitudeAbove(sky_, region.high.y);
    const float widest = top * bottom <= 0 ? 1 : std::cos(std::min(std::abs(top), std::abs(bottom)));
    const uvec2 size = region.high - region.low;
    const float width = 2 * kPi * float(size.x) / float(sky_.size.x) * widest;
    const int axis = size.y == 1 || (size.x > 1 && width > top - bottom) ? 0 : 1;
    std::vector<double> sums(size[axis], 0);
    forEach(region, [&](uint32_t x, uint32_t y) {
      sums[uvec2(x, y)[axis] - region.low[axis]] +=
          double(luminanceOf(sky_.luminance[std::size_t{y} * sky_.size.x + x]) * skyCellAngle(sky_, y));
    });
    for (std::size_t i = 1; i < sums.size(); ++i) sums[i] += sums[i - 1];
    // The edge that parts the flux most evenly.
    std::size_t edge = 1;
    for (std::size_t i = 1; i < sums.size(); ++i)
      if (std::abs(sums[i - 1] - 0.5 * sums.back()) < std::abs(sums[edge - 1] - 0.5 * sums.back())) edge = i;
    Halves parts{region, region, sums.back() > 0 ? sums[edge - 1] / sums.back() : 0.5};
    parts.first.high[axis] = parts.second.low[axis] = region.low[axis] + static_cast<uint32_t>(edge);
    return parts;
  }

  const SkyMap& sky_;
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

std::vector<SkyPart> skyParts(const SkyMap& sky, uint32_t count) {
  Cutter cutter(sky);
  cutter.cut({uvec2(0), sky.size}, std::max(count, 2u));
  return std::move(cutter.found);
}

}  // namespace nephroid
