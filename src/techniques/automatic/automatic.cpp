// What suits each caster: light volumes for water, illumination textures for all else.
#include "techniques/composite.h"
#include "techniques/technique_info.h"

namespace nephroid {

extern const TechniqueInfo kIlluminationTextures, kLightVolumes;

namespace {

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  const Scene& scene = context.transport.scene();
  bool isWaterThere = false, isSolidThere = false;
  for (const Object& object : scene.objects) {
    if (!scene.isCaster(object)) continue;
    (object.water ? isWaterThere : isSolidThere) = true;
  }
  std::vector<std::unique_ptr<Technique>> parts;
  TechniqueContext own = context;
  own.casters = Casters::solid;
  if (isSolidThere || !isWaterThere) parts.push_back(kIlluminationTextures.make(own));
  own.casters = Casters::water;
  if (isWaterThere) parts.push_back(kLightVolumes.make(own));
  return std::make_unique<CompositeTechnique>(std::move(parts));
}

constexpr const TechniqueInfo* kParts[] = {&kIlluminationTextures, &kLightVolumes};

constexpr Omission kOmissions[] = {
    omissions::kReflection,  omissions::kSpectrum,        omissions::kFarFromMean,
    omissions::kPlaneDetail, omissions::kScatteringAside,
};

}  // namespace

extern const TechniqueInfo kAutomatic;
constinit const TechniqueInfo kAutomatic{
    .name = "automatic",
    .summary = "What suits each caster: light volumes for water, illumination textures for all else",
    .make = make,
    .traits = {.usesBeams = true},
    .omissions = kOmissions,
    .parts = kParts,
    .prepare = prepareTransport,
    .isStillPrepared = isTransportStillPrepared,
    .isInSensorPlane =
        [](const TechniqueSettings& settings) { return kIlluminationTextures.isInSensorPlane(settings); },
};

}  // namespace nephroid
