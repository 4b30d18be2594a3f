#include "render/frame_resources.h"

#include "shaders/render/layers_frag.h"
#include "shaders/render/picture_frag.h"
#include "shaders/render/receiver_frag.h"
#include "shaders/render/surface_vert.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kFrameFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat kBytes = VK_FORMAT_R8G8B8A8_UNORM;

// Of the casters that may be in sight.
std::vector<CasterTraits> traitsOf(const LuminanceTraits& luminance) {
  std::vector<CasterTraits> all;
  for (const CasterTraits traits :
       {CasterTraits{false, false, false, false}, CasterTraits{true, false, false, false},
        CasterTraits{true, true, false, false}, CasterTraits{true, true, true, false},
        CasterTraits{true, false, false, true}})
    if (!traits.areSeen || traits.byRays == luminance.isSeenByRays) all.push_back(traits);
  return all;
}

std::vector<gpu::SpecializationConstant> choicesFor(const CasterTraits& traits,
                                                    const LuminanceTraits& luminance) {
  return {{"kHasEmission", luminance.hasEmission}, {"kSeesCasters", traits.areSeen},
          {"kReflects", traits.reflect},           {"kDisperses", traits.disperse},
          {"kHasAir", luminance.hasAir},           {"kHasTurbidWater", luminance.hasTurbidWater},
          {"kSeenByRays", traits.byRays}};
}

}  // namespace

SeenImages createSeenImages(gpu::Device& device, uint32_t width, uint32_t height) {
  const auto image = [&](const char* name) {
    return gpu::createImage(device, name, {.format = kFrameFormat, .width = width, .height = height});
  };
  return {image("receiver position"), image("receiver normal"), image("receiver albedo"),
          image("transmittance"),     image("direct lux"),      image("caustics lux")};
}

FrameImages createFrameImages(gpu::Device& device, uint32_t width, uint32_t height) {
  const auto image = [&](const char* name, VkFormat format = kFrameFormat) {
    return gpu::createImage(device, name, {.format = format, .width = width, .height = height});
  };
  FrameImages images;
  images.depth = image("depth", kDepth);
  images.seen[kSeen] = createSeenImages(device, width, height);
  images.casterNormal = image("caster normal");
  images.picture = image("picture", kBytes);
  return images;
}

FramePrograms createFramePrograms(gpu::Device& device, const LuminanceTraits& luminance, ToneCurve tone) {
  gpu::RasterState receiver;
  receiver.colors = {{kFrameFormat}, {kFrameFormat}, {kFrameFormat}};
  receiver.depthFormat = kDepth;
  receiver.depthCompare = VK_COMPARE_OP_GREATER;

  FramePrograms programs;
  programs.receiver =
      gpu::createRasterProgram(device, "receiver", shaders::render_surface_vert,
                               shaders::render_receiver_frag, receiver, {{"kHasTexture", VK_FALSE}});
  programs.texturedReceiver =
      gpu::createRasterProgram(device, "textured receiver", shaders::render_surface_vert,
                               shaders::render_receiver_frag, receiver, {{"kHasTexture", VK_TRUE}});
  programs.picture = createPicturePrograms(device, luminance, tone);
  for (const CasterTraits& traits : traitsOf(luminance))
    programs.layers[traits] = gpu::createRasterProgram(
        device, "layers", shaders::techniques_whole_picture_vert, shaders::render_layers_frag,
        {.colors = std::vector<gpu::ColorTarget>(4, {kFrameFormat, gpu::Blend::add})},
        choicesFor(traits, luminance));
  return programs;
}

std::map<CasterTraits, gpu::Program> createPicturePrograms(gpu::Device& device,
                                                           const LuminanceTraits& luminance, ToneCurve tone) {
  std::map<CasterTraits, gpu::Program> programs;
  for (const CasterTraits& traits : traitsOf(luminance)) {
    std::vector<gpu::SpecializationConstant> choices = choicesFor(traits, luminance);
    choices.push_back({"kToneCurve", uint32_t(tone)});
    programs[traits] =
        gpu::createRasterProgram(device, "picture", shaders::techniques_whole_picture_vert,
                                 shaders::render_picture_frag, {.colors = {{kBytes}}}, choices);
  }
  return programs;
}

}  // namespace nephroid
