#include "render/frame_resources.h"

#include "shaders/layers_frag.h"
#include "shaders/picture_frag.h"
#include "shaders/receiver_frag.h"
#include "shaders/surface_vert.h"
#include "shaders/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kFrameFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;
constexpr VkFormat kBytes = VK_FORMAT_R8G8B8A8_UNORM;

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
  images.seen = createSeenImages(device, width, height);
  images.casterNormal = image("caster normal");
  images.luminance = image("luminance");
  images.directLuminance = image("direct luminance");
  images.causticsLuminance = image("caustics luminance");
  images.picture = image("picture", kBytes);
  return images;
}

FramePrograms createFramePrograms(gpu::Device& device, const LuminanceTraits& luminance) {
  gpu::RasterState receiver;
  receiver.colors = {{kFrameFormat}, {kFrameFormat}, {kFrameFormat}};
  receiver.depthFormat = kDepth;
  receiver.depthCompare = VK_COMPARE_OP_GREATER;

  FramePrograms programs;
  programs.receiver = gpu::createRasterProgram(device, "receiver", shaders::surface_vert,
                                               shaders::receiver_frag, receiver, {{0, VK_FALSE}});
  programs.texturedReceiver = gpu::createRasterProgram(device, "textured receiver", shaders::surface_vert,
                                                       shaders::receiver_frag, receiver, {{0, VK_TRUE}});
  for (const CasterTraits traits : {CasterTraits{false, false, false}, CasterTraits{true, false, false},
                                    CasterTraits{true, true, false}, CasterTraits{true, true, true}}) {
    const std::vector<gpu::SpecializationConstant> choices{
        {0, luminance.hasEmission}, {1, traits.areSeen},   {2, traits.reflect},
        {3, traits.disperse},       {4, luminance.hasAir}, {5, luminance.hasTurbidWater}};
    programs.picture[traits] =
        gpu::createRasterProgram(device, "picture", shaders::whole_picture_vert, shaders::picture_frag,
                                 {.colors = {{kBytes}}}, choices);
    programs.layers[traits] =
        gpu::createRasterProgram(device, "layers", shaders::whole_picture_vert, shaders::layers_frag,
                                 {.colors = {{kFrameFormat}, {kFrameFormat}, {kFrameFormat}}}, choices);
  }
  return programs;
}

}  // namespace nephroid
