#include "beams/ray_mesh/caster_scales.h"

#include <algorithm>
#include <numeric>

#include "geometry/bounds.h"

namespace nephroid {

CasterScales::CasterScales(const Scene& scene, const RayMeshSettings& settings) : settings_(settings) {
  for (const Object& object : scene.objects)
    sizes_.push_back(
        scene.isCaster(object) ? object.placement.scale * boundingBox(scene.meshOf(object)).diagonal() : 0);
}

float CasterScales::pointAt(vec3 position, uint32_t caster) const {
  const float most = std::max(settings_.mostDetailOfCaster * sizes_[caster], settings_.detail);
  return std::clamp(settings_.detailPerMeter * distance(position, settings_.eye), settings_.detail, most);
}

std::vector<float> CasterScales::fullFluxes(std::span<const CasterLight> lights,
                                            std::span<const double> fluxes) const {
  constexpr double kFewCasters = 8;
  std::vector<double> ofCaster(sizes_.size());
  for (std::size_t i = 0; i < lights.size(); ++i) ofCaster[lights[i].object] += fluxes[i];
  const double all = std::accumulate(ofCaster.begin(), ofCaster.end(), 0.0);
  const auto lit = std::ranges::count_if(ofCaster, [](double flux) { return flux > 0; });
  const double crowding = std::max(double(lit) / kFewCasters, 1.0);
  std::vector<float> full;
  for (const CasterLight& light : lights)
    full.push_back(float(std::min(crowding * ofCaster[light.object], all)));
  return full;
}

}  // namespace nephroid
