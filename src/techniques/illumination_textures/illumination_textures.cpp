// Illumination textures (Iwasaki, Dobashi, Yoshimoto and Nishita 2005): caustics on receivers of any shape by
// way of textures on virtual planes around them. What is made does not depend on the view.
#include <algorithm>

#include "techniques/illumination_textures/settings.h"
#include "techniques/planes/plane_technique.h"

namespace nephroid {
namespace {

constexpr TechniqueTraits kTraits{.usesBeams = true};

constexpr Setting planesSetting() {
  Setting planes = wholeSetting<&IlluminationTextureSettings::planes>(
      "planes", 1, 256, "Number of virtual planes around the receivers, on which caustics are drawn");
  planes.wordForZero = "sensor";
  return planes;
}
constexpr Setting kSettings[] = {planesSetting()};
constexpr SettingsOwner kOwners[] = {
    settingsOwner<IlluminationTextureSettings>("illumination-textures", kSettings), kPlaneSettingsOwner};

constexpr Omission kOmissions[] = {
    omissions::kReflection,  omissions::kSpectrum,    omissions::kSizeOfLamps,
    omissions::kFarFromMean, omissions::kPlaneDetail, omissions::kScattering,
};

PlaneSet planTextures(const Scene&, const LightPortion& portion, std::span<const ReceiverBox> boxes,
                      uint32_t planes, uint32_t textureSize) {
  return planAlongLight(portion, boxes, planes, textureSize);
}

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  const uint32_t planes = context.settings.own.of<IlluminationTextureSettings>().planes;
  return std::make_unique<PlaneTechnique>(
      context, PlaneTechniqueKind{kTraits, planTextures, std::max(planes, 1u), true,
                                  "receivers from the light", "illumination textures"});
}

}  // namespace

extern const TechniqueInfo kIlluminationTextures;
constinit const TechniqueInfo kIlluminationTextures{
    .name = "illumination-textures",
    .summary = "Textures of illuminance on virtual planes across the light (paper 2): the fastest for glass",
    .make = make,
    .traits = kTraits,
    .settings = kOwners,
    .omissions = kOmissions,
    .prepare = prepareTransport,
    .isStillPrepared = isTransportStillPrepared,
    .isInSensorPlane =
        [](const TechniqueSettings& settings) {
          return settings.own.of<IlluminationTextureSettings>().planes == 0;
        },
};

}  // namespace nephroid
