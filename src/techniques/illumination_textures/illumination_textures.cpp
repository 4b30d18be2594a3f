#include "techniques/illumination_textures/illumination_textures.h"

#include "techniques/planes/plane_technique.h"

namespace nephroid {
namespace {

PlaneSet planTextures(const Scene&, const LightPortion& portion, std::span<const ReceiverBox> boxes,
                      const TechniqueSettings& settings) {
  return planAlongLight(portion, boxes, std::max(settings.planes, 1u), settings.textureSize);
}

}  // namespace

std::unique_ptr<Technique> makeIlluminationTextures(const TechniqueContext& context) {
  return std::make_unique<PlaneTechnique>(
      context,
      PlaneTechniqueTraits{planTextures, true, false, "receivers from the light", "illumination textures"});
}

}  // namespace nephroid
