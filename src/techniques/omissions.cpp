#include "techniques/omissions.h"

#include <algorithm>

#include "lights/lamp_light.h"
#include "scene/volume.h"

namespace nephroid {

bool hasCaster(const Scene& scene) {
  return anyMaterial(scene, [](const Material& material) { return material.isCaster(); });
}

bool hasLampWithASize(const Scene& scene) {
  return hasCaster(scene) && std::ranges::any_of(scene.lights, hasSize);
}

bool hasGlass(const Scene& scene) {
  return anyMaterial(scene,
                     [](const Material& material) { return material.type == MaterialType::dielectric; });
}

bool hasDispersion(const Scene& scene) {
  return anyMaterial(scene, [](const Material& material) {
    return material.type == MaterialType::dielectric && material.isDispersive();
  });
}

bool hasNearLight(const Scene& scene) {
  return hasCaster(scene) && std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
           return light.type != LightType::directional && light.type != LightType::sky;
         });
}

bool hasWaterOrSheet(const Scene& scene) {
  return anyMaterial(scene, [](const Material& material) { return material.thinWalled; }) ||
         std::any_of(scene.objects.begin(), scene.objects.end(),
                     [](const Object& object) { return object.water.has_value(); });
}

bool hasScattering(const Scene& scene) {
  return anyMaterial(scene, [](const Material& material) { return scatters(material); });
}

}  // namespace nephroid
