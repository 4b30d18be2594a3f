#include "render/omissions.h"

#include <algorithm>

namespace nephroid {
namespace {

bool hasSky(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return light.type == LightType::sky; });
}

bool hasLampWithParts(const Scene& scene) {
  return (scene.medium || hasCaster(scene)) &&
         std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
           return light.type == LightType::line || light.type == LightType::area;
         });
}

bool hasShadowMaps(const Scene& scene) {
  return hasSky(scene) || (scene.medium.has_value() && !scene.lights.empty());
}

bool hasMediumAndCaster(const Scene& scene) {
  return scene.medium.has_value() && hasCaster(scene);
}

bool hasLightAndReceiver(const Scene& scene) {
  return !scene.lights.empty() &&
         anyMaterial(scene, [](const Material& material) { return !material.isCaster(); });
}

bool always(const Scene&) {
  return true;
}

}  // namespace

std::span<const Omission> omissionsOfFrame() {
  static constexpr Omission kOmissions[] = {
      {"In the view through casters by rays: ways that carry less than a thousandth of what their pixel "
       "shows, in whose place the others count for more, and ways that meet more than 48 boundaries",
       hasCaster},
      {"In the view through casters by slices (--sight slices, and always with light-volumes): other casters "
       "in what the outside of glass reflects, and what is reflected inside where it could have left",
       hasGlass},
      {"The air, where light met a caster: what it scatters of that light and takes of it; and what it "
       "scatters "
       "behind glass and in mirrors, and takes of what is seen there",
       hasMediumAndCaster},
      {"The extent of skies: a sky is a number of directions, in light, shadows and caustics", hasSky},
      {"The extent of lights, in shafts and in caustics but those of adaptive-beams: a line is a row of "
       "points, "
       "an area a grid of them",
       hasLampWithParts},
      {"Shadow edges in shafts and of skies that are finer than two texels of a shadow map; there are as "
       "many "
       "texels as pixels along the picture's longer side, divided by the square root of how many points or "
       "directions a light is",
       hasShadowMaps},
      {"What shades less than a tenth of a pixel or so: where all points around a pixel saw the same of a "
       "lamp "
       "in two samples, so do those of the samples after",
       hasLightAndReceiver},
      {"Smooth edges: a pixel shows what its center sees, not the mean over its square", always},
  };
  return kOmissions;
}

}  // namespace nephroid
