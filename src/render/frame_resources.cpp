#include "render/frame_resources.h"

#include "shaders/caster_frag.h"
#include "shaders/composite_comp.h"
#include "shaders/direct_comp.h"
#include "shaders/receiver_frag.h"
#include "shaders/shadow_vert.h"
#include "shaders/surface_vert.h"
#include "shaders/tone_mapping_comp.h"
#include "shaders/view_transmittance_frag.h"

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
  images.casterPosition = image("caster position");
  images.casterNormal = image("caster normal");
  images.opticalDepth = image("optical depth");
  images.directLux = image("direct lux");
  images.causticsLux = image("caustics lux");
  images.luminance = image("luminance");
  images.directLuminance = image("direct luminance");
  images.causticsLuminance = image("caustics luminance");
  images.picture = image("picture", VK_FORMAT_R8G8B8A8_UNORM);
  return images;
}

FramePrograms createFramePrograms(gpu::Device& device) {
  const auto compute = [&](const char* name, std::span<const uint32_t> words, uint32_t choice = 0) {
    return gpu::createComputeProgram(device, name, words, {{0, choice}});
  };
  const auto surface = [&](const char* name, std::span<const uint32_t> fragment,
                           const gpu::RasterState& state) {
    return gpu::createRasterProgram(device, name, shaders::surface_vert, fragment, state);
  };
  gpu::RasterState receiver;
  receiver.colors = {{kFloats}, {kFloats}, {kFloats}};
  receiver.depthFormat = kDepth;
  receiver.depthCompare = VK_COMPARE_OP_GREATER;
  gpu::RasterState mirror = receiver;
  mirror.colors = {{kFloats}, {kFloats}};
  gpu::RasterState dielectric = mirror;
  dielectric.cull = VK_CULL_MODE_BACK_BIT;
  gpu::RasterState transmittance = receiver;
  transmittance.colors = {{kFloats, gpu::Blend::add}};
  transmittance.depthWrite = false;
  gpu::RasterState shadow;
  shadow.depthFormat = kDepth;

  FramePrograms programs;
  programs.shadow = gpu::createRasterProgram(device, "shadow", shaders::shadow_vert, {}, shadow);
  programs.receiver = surface("receiver", shaders::receiver_frag, receiver);
  programs.mirror = surface("mirror", shaders::caster_frag, mirror);
  programs.viewTransmittance = surface("view transmittance", shaders::view_transmittance_frag, transmittance);
  programs.dielectric = surface("dielectric", shaders::caster_frag, dielectric);
  programs.direct = compute("direct", shaders::direct_comp);
  programs.composite = compute("composite", shaders::composite_comp);
  programs.compositeLayers = compute("composite layers", shaders::composite_comp, VK_TRUE);
  programs.toneMapping = compute("tone mapping", shaders::tone_mapping_comp);
  return programs;
}

}  // namespace nephroid
