// The smallest technique there can be: it lights everything evenly, has one setting and bakes nothing. It
// shows what a technique's folder holds, and proves that nothing outside has to know of it.
#include "gpu/program.h"
#include "shaders/techniques/whole_picture_vert.h"
#include "shaders/tests/techniques/even_light/even_frag.h"
#include "techniques/even_light/settings.h"
#include "techniques/technique_info.h"

namespace nephroid {
namespace {

constexpr TechniqueTraits kTraits{.coversSquares = true};

class EvenLight final : public TechniqueBase {
 public:
  explicit EvenLight(const TechniqueContext& context)
      : lux_(float(context.settings.own.of<EvenLightSettings>().lux)),
        program_(gpu::createRasterProgram(context.device, "even light",
                                          shaders::techniques_whole_picture_vert,
                                          shaders::tests_techniques_even_light_even_frag,
                                          {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}})) {}

  TechniqueTraits traits() const override { return kTraits; }
  void update(GpuScene&) override {}
  void shade(gpu::CommandList& commands, const ReceiverPoints& points,
             const gpu::Image& causticsLux) override {
    drawCaustics(commands, points, causticsLux, [&] { commands.draw(program_, 3, 1, lux_); });
  }

 private:
  vec3 lux_;
  gpu::Program program_;
};

std::unique_ptr<Technique> make(const TechniqueContext& context) {
  return std::make_unique<EvenLight>(context);
}

constexpr Setting kSettings[] = {
    realSetting<&EvenLightSettings::lux>("even-lux", 0, 1e6, "Illuminance of every receiver in lux"),
};
constexpr SettingsOwner kOwners[] = {settingsOwner<EvenLightSettings>("even-light", kSettings)};

constexpr Omission kOmissions[] = {{"Everything but an even light", hasCaster}};

}  // namespace

extern const TechniqueInfo kEvenLight;
constinit const TechniqueInfo kEvenLight{
    .name = "even-light",
    .summary = "The same light on every receiver",
    .make = make,
    .traits = kTraits,
    .settings = kOwners,
    .omissions = kOmissions,
};

}  // namespace nephroid
