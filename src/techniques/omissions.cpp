#include "techniques/omissions.h"

#include <algorithm>

#include "scene/volume.h"

namespace nephroid {
namespace {

template <class Test>
bool anyMaterial(const Scene& scene, const Test& test) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& object) { return test(scene.materialOf(object)); });
}

bool hasCaster(const Scene& scene) {
  return anyMaterial(scene, [](const Material& material) { return material.isCaster(); });
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

bool hasExtendedLight(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(), [](const Light& light) {
    return light.type == LightType::line || light.type == LightType::area || light.type == LightType::sky;
  });
}

bool hasSky(const Scene& scene) {
  return std::any_of(scene.lights.begin(), scene.lights.end(),
                     [](const Light& light) { return light.type == LightType::sky; });
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
      {"The view in glass past the nearest way: of what a caster reflects only its outside's is shown, "
       "without "
       "other casters in it, and of what goes through it nothing that was reflected where it could have gone "
       "on",
       hasGlass},
      {"The air: what it scatters of light that met a caster, and takes of it on the way to receivers; what "
       "it "
       "scatters behind glass and in mirrors, and takes of what is seen there",
       hasMediumAndCaster},
      {"The extent of lights: a line is a row of points, an area a grid of them, a sky a number of "
       "directions, in "
       "light, shadows and caustics",
       hasExtendedLight},
      {"The sky itself: where nothing stands, and in glass and mirrors, the background is seen", hasSky},
      {"Shadow edges finer than two texels of a shadow map; there are as many texels as pixels along the "
       "picture's longer side, divided by the square root of how many points or directions a light is",
       hasLightAndReceiver},
      {"Smooth edges: a pixel shows what its centre sees, not the mean over its square", always},
  };
  return kOmissions;
}

// What techniques by way of virtual planes share.
constexpr Omission kReflection{
    "Reflection at glass, outside, inside and total, unless --paths all asks for it, and then most of "
    "what is reflected after the fourth surface at which it could be reflected or transmitted",
    hasGlass};
constexpr Omission kSpectrum{
    "The spectrum: light that disperses goes in three bands, red, green and blue, not by wavelength",
    hasDispersion};
constexpr Omission kDetail{
    "Detail between the rays of a caster's vertices, and finer than a texel of the virtual planes",
    hasCaster};
constexpr Omission kScattering{"Light that water and glass scatter inside", hasScattering};

constexpr Omission kOfIlluminationTextures[] = {
    kReflection,
    kSpectrum,
    {"Light far from a caster's mean direction: what leaves it at more than 75 degrees from the mean, and "
     "what reaches surfaces that another receiver hides along the mean or that face away from it",
     hasCaster},
    kDetail,
    kScattering,
};

// By light volumes, of what scatters.
constexpr Omission kScatteringAside{
    "What glass scatters inside, and water of light that met no surface before; what water scatters, where "
    "mirrors and other glass show it, and where its surface reflects a part of it",
    hasScattering};

std::span<const Omission> omissionsOfAutomatic() {
  static constexpr Omission kOmissions[] = {kOfIlluminationTextures[0], kOfIlluminationTextures[1],
                                            kOfIlluminationTextures[2], kOfIlluminationTextures[3],
                                            kScatteringAside};
  return kOmissions;
}

std::span<const Omission> omissionsOfIlluminationTextures() {
  return kOfIlluminationTextures;
}

std::span<const Omission> omissionsOfSlicedImages() {
  static constexpr Omission kOmissions[] = {
      kReflection,
      kSpectrum,
      {"Light that the camera does not see along the mean direction in which it sees the light: on surfaces "
       "that another receiver hides there or that face away, as glass and mirrors may show them",
       hasCaster},
      {"With --interpolation blend, light that runs within 15 degrees along the sample planes", hasCaster},
      kDetail,
      kScattering,
  };
  return kOmissions;
}

std::span<const Omission> omissionsOfIrradianceVolumes() {
  static constexpr Omission kOmissions[] = {
      {"Light beyond --volume-radius bounding radii of a caster's centre, and what fades toward there",
       hasCaster},
      {"Shadows in caustics: what stands between a caster and a receiver hides nothing of its light",
       hasCaster},
      {"Light from one caster through another, and light that other objects keep from a caster", hasCaster},
      {"How near a light stands: it falls on a caster as it does on the caster's centre, from one direction",
       hasNearLight},
      {"Reflection at glass, outside, inside and total, unless --paths all asks for it", hasGlass},
      {"The spectrum: light that disperses goes in three bands, red, green and blue, not by wavelength",
       hasDispersion},
      {"Water and sheets without a volume, which cast no caustics here", hasWaterOrSheet},
      {"Detail finer than a cell of the volume, and between the light directions it was made for", hasCaster},
      kScattering,
  };
  return kOmissions;
}

std::span<const Omission> omissionsOfLightVolumes() {
  static constexpr Omission kOmissions[] = {
      kReflection,
      kSpectrum,
      {"Detail between the rays of a caster's vertices; where receivers hide each other from the light, "
       "that between beams",
       hasCaster},
      kScatteringAside,
  };
  return kOmissions;
}

std::span<const Omission> omissionsOfNoCaustics() {
  static constexpr Omission kOmissions[] = {
      {"Caustics: light that met glass or a mirror is not drawn at all", hasCaster},
      kScattering,
  };
  return kOmissions;
}

}  // namespace nephroid
