#include "reference/sky_distribution.h"

#include <algorithm>

#include "reference/sampling.h"

namespace nephroid {

SkyDistribution::SkyDistribution(const SkyMap& map, float rotation)
    : sky_(map), turned_(skyTurned(rotation)) {
  cumulative_.reserve(sky_.luminance.size());
  double total = 0;
  for (uint32_t y = 0; y < sky_.size.y; ++y)
    for (uint32_t x = 0; x < sky_.size.x; ++x) {
      const vec3 illuminance = sky_.luminance[cumulative_.size()] * skyCellAngle(sky_, y);
      sum_ += illuminance;
      cumulative_.push_back(total += double(illuminance.x + illuminance.y + illuminance.z));
    }
  for (double& part : cumulative_) part /= total;
}

SkyDistribution::Sample SkyDistribution::sample(float u) const {
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end() - 1, double(u));
  const auto cell = static_cast<std::size_t>(found - cumulative_.begin());
  const double before = cell == 0 ? 0 : cumulative_[cell - 1];
  const double probability = cumulative_[cell] - before;
  if (!(probability > 0)) return {};
  // What is left of the number finds the place in the cell: even over its longitude and the sine of its
  // latitude.
  const vec2 within = pointOnCurve(std::clamp((double(u) - before) / probability, 0.0, 1 - 0x1p-48));
  const auto column = uint32_t(cell % sky_.size.x), row = uint32_t(cell / sky_.size.x);
  const float upper = towardSky({0, float(row) / float(sky_.size.y)}).y;
  const float lower = towardSky({0, float(row + 1) / float(sky_.size.y)}).y;
  const float sine = glm::mix(upper, lower, within.y);
  vec3 toward = towardSky({(float(column) + within.x) / float(sky_.size.x), 0.5f});
  toward = vec3(0, sine, 0) + std::sqrt(std::max(1 - sine * sine, 0.0f)) * toward;
  return {turned_ * -toward, sky_.luminance[cell] * (skyCellAngle(sky_, row) / float(probability))};
}

}  // namespace nephroid
