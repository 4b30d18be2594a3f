#include "lights/seen_skies.h"

#include <algorithm>
#include <cmath>

#include "core/directions.h"

namespace nephroid {

struct SkyView {
  const SkyLevels& levels;
};
static int skyLevelCount(const SkyView& sky) {
  return sky.levels.count();
}
static ivec2 skyLevelSize(const SkyView& sky, int level) {
  return ivec2(sky.levels[level].size);
}
static vec3 skyTexel(const SkyView& sky, ivec2 at, int level) {
  const SkyMap& map = sky.levels[level];
  return map.luminance[std::size_t(at.y) * map.size.x + std::size_t(at.x)];
}

}  // namespace nephroid

#include "lights/sky_lookup.h"

namespace nephroid {
namespace {

// The cells of a side that a cell of the next level covers, and how much of each.
struct Covered {
  uint32_t first = 0;
  std::vector<float> parts;
};

Covered coveredBy(uint32_t cell, uint32_t fine, uint32_t coarse) {
  const double low = double(cell) * fine / coarse, high = double(cell + 1) * fine / coarse;
  Covered covered{uint32_t(low), {}};
  for (uint32_t i = covered.first; i < fine && double(i) < high; ++i)
    covered.parts.push_back(float(std::min(high, double(i + 1)) - std::max(low, double(i))));
  return covered;
}

SkyMap coarserLevel(const SkyMap& fine) {
  SkyMap coarse{fine.name, glm::max(fine.size / 2u, uvec2(1)), {}};
  coarse.luminance.reserve(std::size_t{coarse.size.x} * coarse.size.y);
  std::vector<Covered> columnsOf;
  for (uint32_t x = 0; x < coarse.size.x; ++x) columnsOf.push_back(coveredBy(x, fine.size.x, coarse.size.x));
  for (uint32_t y = 0; y < coarse.size.y; ++y) {
    const Covered rows = coveredBy(y, fine.size.y, coarse.size.y);
    for (const Covered& columns : columnsOf) {
      vec3 sum(0);
      float weights = 0;
      for (uint32_t j = 0; j < rows.parts.size(); ++j) {
        const uint32_t row = rows.first + j;
        const float wide = std::sin(kPi * (float(row) + 0.5f) / float(fine.size.y));
        for (uint32_t i = 0; i < columns.parts.size(); ++i) {
          const float weight = rows.parts[j] * columns.parts[i] * wide;
          sum += weight * fine.luminance[std::size_t{row} * fine.size.x + columns.first + i];
          weights += weight;
        }
      }
      coarse.luminance.push_back(sum / weights);
    }
  }
  return coarse;
}

}  // namespace

SkyLevels::SkyLevels(const SkyMap& map) : map_(&map) {
  while ((*this)[count() - 1].size != uvec2(1)) coarser_.push_back(coarserLevel((*this)[count() - 1]));
}

SkySight sightOf(const Scene& scene, const Light& sky) {
  const float angle = glm::radians(sky.skyRotation);
  SkySight sight{sky.intensity, {std::cos(angle), std::sin(angle)}, vec3(0), 0, vec3(0)};
  if (sky.sun == kNone) return sight;
  const Light& sun = scene.lights[sky.sun];
  sight.disk = -sun.direction;
  sight.diskRadius = std::sin(glm::radians(0.5f * sun.angle));
  if (sight.diskRadius > 0)
    sight.diskLuminance = sun.illuminance / (kPi * sight.diskRadius * sight.diskRadius);
  return sight;
}

bool SeenSkies::place(const Scene& scene) {
  std::vector<SeenSky> all;
  for (const Light& light : scene.lights)
    if (light.type == LightType::sky && light.isSeen)
      all.push_back({sightOf(scene, light), light.skyMap,
                     &levels_.try_emplace(light.skyMap, maps_[light.skyMap]).first->second});
  const bool isSame = std::ranges::equal(
      all, all_, [](const SeenSky& a, const SeenSky& b) { return a.map == b.map && a.sight == b.sight; });
  all_ = std::move(all);
  return !isSame;
}

vec3 SeenSkies::mean() const {
  vec3 sum(0);
  for (const SeenSky& sky : all_)
    sum += sky.sight.intensity * (*sky.levels)[sky.levels->count() - 1].luminance[0];
  return sum;
}

vec3 SeenSkies::luminance(vec3 toward, float width) const {
  vec3 sum(0);
  for (const SeenSky& sky : all_) sum += skyLuminance(SkyView{*sky.levels}, sky.sight, toward, width);
  return sum;
}

}  // namespace nephroid
