#include "render/frame_resources.h"

#include "shaders/caster_frag.h"
#include "shaders/caster_view_frag.h"
#include "shaders/composite_comp.h"
#include "shaders/mirror_frag.h"
#include "shaders/receiver_frag.h"
#include "shaders/surface_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kDepth = VK_FORMAT_D32_SFLOAT;

}  // namespace

FrameImages createFrameImages(gpu::Device& device, uint32_t width, uint32_t height) {
  const auto image = [&](const char* name, VkFormat format = kFloats) {
    return gpu::createImage(device, name, {.format = format, .width = width, .height = height});
  };
  FrameImages images;
  images.depth = image("depth", kDepth);
  images.receiverPosition = image("receiver position");
  images.receiverNormal = image("receiver normal");
  images.receiverAlbedo = image("receiver albedo");
  images.casterNormal = image("caster normal");
  images.casterReflectance = image("caster reflectance");
  images.opticalDepth = image("optical depth");
  images.directLux = image("direct lux");
  images.causticsLux = image("caustics lux");
  images.luminance = image("luminance");
  images.directLuminance = image("direct luminance");
  images.causticsLuminance = image("caustics luminance");
  images.picture = image("picture", VK_FORMAT_R8G8B8A8_UNORM);
  return images;
}

FramePrograms createFramePrograms(gpu::Device& device, bool hasEmission) {
  using Choices = std::vector<gpu::SpecializationConstant>;
  const auto surface = [&](const char* name, std::span<const uint32_t> fragment,
                           const gpu::RasterState& state, const Choices& choices = {}) {
    return gpu::createRasterProgram(device, name, shaders::surface_vert, fragment, state, choices);
  };
  gpu::RasterState receiver;
  receiver.colors = {{kFloats}, {kFloats}, {kFloats}};
  receiver.depthFormat = kDepth;
  receiver.depthCompare = VK_COMPARE_OP_GREATER;
  gpu::RasterState mirror = receiver;
  mirror.colors = {{kFloats}, {kFloats}};
  gpu::RasterState dielectric = receiver;
  dielectric.colors = {{kFloats, gpu::Blend::add}, {kFloats, gpu::Blend::add}};
  dielectric.depthWrite = false;
  gpu::RasterState nearest = receiver;
  nearest.colors = {{kFloats}};
  nearest.depthCompare = VK_COMPARE_OP_GREATER_OR_EQUAL;

  FramePrograms programs;
  programs.receiver = surface("receiver", shaders::receiver_frag, receiver);
  programs.texturedReceiver = surface("textured receiver", shaders::receiver_frag, receiver, {{0, VK_TRUE}});
  programs.mirror = surface("mirror", shaders::mirror_frag, mirror);
  programs.dielectric = surface("dielectric", shaders::caster_view_frag, dielectric);
  programs.nearestCaster = surface("nearest caster", shaders::caster_frag, nearest);
  for (const uint32_t writesLayers : {0u, 1u})
    for (const uint32_t seesCasters : {0u, 1u})
      programs.composite[writesLayers][seesCasters] =
          gpu::createComputeProgram(device, "composite", shaders::composite_comp,
                                    {{0, writesLayers}, {1, hasEmission}, {2, seesCasters}});
  return programs;
}

}  // namespace nephroid
