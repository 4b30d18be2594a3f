#include "techniques/registry.h"

#include <algorithm>
#include <vector>

#include "core/error.h"
#include "techniques/illumination_textures/illumination_textures.h"
#include "techniques/irradiance_volume/irradiance_volume.h"
#include "techniques/light_volumes/light_volumes.h"
#include "techniques/sliced_images/sliced_images.h"

namespace nephroid {
namespace {

class NoCaustics final : public Technique {
 public:
  void update(GpuScene&) override {}
  void record(gpu::CommandList&, GpuScene&) override {}
  void shade(gpu::CommandList&, const ReceiverPoints&, const gpu::Image&) override {}
};

// What suits each caster: water's light by light volumes, that of all else by illumination textures.
class Automatic final : public Technique {
 public:
  explicit Automatic(const TechniqueContext& context) {
    const Scene& scene = context.transport.scene();
    bool isWaterThere = false, isSolidThere = false;
    for (const Object& object : scene.objects) {
      if (!scene.isCaster(object)) continue;
      (object.water ? isWaterThere : isSolidThere) = true;
    }
    TechniqueContext own = context;
    own.casters = Casters::solid;
    if (isSolidThere || !isWaterThere) parts.push_back(makeIlluminationTextures(own));
    own.casters = Casters::water;
    if (isWaterThere) parts.push_back(makeLightVolumes(own));
  }

  void reserve(uvec2 size) override {
    for (const auto& part : parts) part->reserve(size);
  }
  void update(GpuScene& gpuScene) override {
    for (const auto& part : parts) part->update(gpuScene);
  }
  void record(gpu::CommandList& commands, GpuScene& gpuScene) override {
    for (const auto& part : parts) part->record(commands, gpuScene);
  }
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override {
    for (const auto& part : parts) part->shade(commands, points, causticsLux);
  }
  void scatter(gpu::CommandList& commands, const WaysOfSight& ways, const gpu::Image& luminance) override {
    for (const auto& part : parts) part->scatter(commands, ways, luminance);
  }
  bool coversSquares() const override {
    return std::ranges::all_of(parts, [](const auto& part) { return part->coversSquares(); });
  }
  bool finish() override {
    bool isDone = true;
    for (const auto& part : parts) isDone = part->finish() && isDone;
    return isDone;
  }
  std::vector<Lattice> lattices() const override { return ofParts(&Technique::lattices); }
  std::vector<PassOutput> outputs() const override { return ofParts(&Technique::outputs); }

 private:
  template <class Element>
  std::vector<Element> ofParts(std::vector<Element> (Technique::*get)() const) const {
    std::vector<Element> all;
    for (const auto& part : parts)
      for (const Element& element : ((*part).*get)()) all.push_back(element);
    return all;
  }

  std::vector<std::unique_ptr<Technique>> parts;
};

constexpr TechniqueEntry kTechniques[] = {
    {kAutomaticName,
     [](const TechniqueContext& context) -> std::unique_ptr<Technique> {
       return std::make_unique<Automatic>(context);
     },
     omissionsOfAutomatic},
    {"illumination-textures", makeIlluminationTextures, omissionsOfIlluminationTextures},
    {"irradiance-volume", makeIrradianceVolumes, omissionsOfIrradianceVolumes},
    {"light-volumes", makeLightVolumes, omissionsOfLightVolumes},
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
