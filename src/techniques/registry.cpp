#include "techniques/registry.h"

#include <vector>

#include "core/error.h"
#include "techniques/illumination_textures/illumination_textures.h"
#include "techniques/irradiance_volume/irradiance_volume.h"
#include "techniques/sliced_images/sliced_images.h"

namespace nephroid {
namespace {

class NoCaustics final : public Technique {
 public:
  void update(GpuScene&) override {}
  void record(gpu::CommandList&, GpuScene&) override {}
  void shade(gpu::CommandList&, const ReceiverPoints&, const gpu::Image&) override {}
};

constexpr TechniqueEntry kTechniques[] = {
    {"illumination-textures", makeIlluminationTextures, omissionsOfIlluminationTextures},
    {"irradiance-volume", makeIrradianceVolumes, omissionsOfIrradianceVolumes},
    {"sliced-images", makeSlicedImages, omissionsOfSlicedImages},
    {"none",
     [](const TechniqueContext&) -> std::unique_ptr<Technique> { return std::make_unique<NoCaustics>(); },
     omissionsOfNoCaustics},
};

}  // namespace

std::span<const TechniqueEntry> techniques() {
  return kTechniques;
}

std::unique_ptr<Technique> makeTechnique(const TechniqueContext& context) {
  const std::string& wanted = context.settings.technique;
  std::vector<std::string> names;
  std::string all;
  for (const TechniqueEntry& entry : kTechniques) {
    if (entry.name == wanted) return entry.make(context);
    names.emplace_back(entry.name);
    all += (all.empty() ? "" : ", ") + names.back();
  }
  const std::string nearest = nearestName(wanted, names);
  throw InputError("--technique: there is no technique \"" + wanted + "\"; " +
                   (nearest.empty() ? "there are: " + all : "did you mean \"" + nearest + "\"?"));
}

}  // namespace nephroid
