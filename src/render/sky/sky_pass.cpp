#include "render/sky/sky_pass.h"

#include "gpu/transfer.h"
#include "shaders/render/sky/sky_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

gpu::Program program(gpu::Device& device, uint32_t way) {
  gpu::RasterState state;
  state.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}};
  if (way == kSkyOpen) {
    state.depthFormat = VK_FORMAT_D32_SFLOAT;
    state.depthCompare = VK_COMPARE_OP_EQUAL;
    state.depthWrite = false;
  }
  return gpu::createRasterProgram(device, "sky", shaders::techniques_whole_picture_vert,
                                  shaders::render_sky_sky_frag, state, {{"kWay", way}});
}

gpu::Image upload(gpu::Device& device, const SkyLevels& levels) {
  gpu::Image image = gpu::createImage(
      device, "sky",
      {.width = levels[0].size.x, .height = levels[0].size.y, .mipLevels = uint32_t(levels.count())});
  std::vector<std::vector<std::byte>> bytes;
  for (int level = 0; level < levels.count(); ++level) {
    std::vector<vec4> texels;
    texels.reserve(levels[level].luminance.size());
    for (const vec3& luminance : levels[level].luminance) texels.emplace_back(luminance, 1);
    const auto part = std::as_bytes(std::span(texels));
    bytes.emplace_back(part.begin(), part.end());
  }
  gpu::uploadImage(device, image, bytes);
  return image;
}

}  // namespace

SkyPass::SkyPass(gpu::Device& device, const Scene& scene)
    : device_(device),
      skies_(scene),
      programs_{program(device, kSkyOpen), program(device, kSkyThrough), program(device, kSkyReflected)} {}

bool SkyPass::update(const Scene& scene) {
  const bool differs = skies_.place(scene);
  for (const SeenSky& sky : skies_.all())
    if (!maps_.contains(sky.map)) maps_.emplace(sky.map, upload(device_, *sky.levels));
  return differs;
}

void SkyPass::look(const View& view, uvec2 pictureSize, float spacing) {
  const PictureRays rays = raysOf(view);
  constants_.middle = rays.middle;
  constants_.right = rays.right;
  constants_.down = rays.down;
  constants_.imageSize = vec2(pictureSize);
  constants_.eye = view.eye;
  constants_.width = spacing * view.pixelAngle;
  constants_.spacing = spacing;
}

void SkyPass::record(gpu::CommandList& commands, const FrameImages& images) const {
  const SeenImages& seen = images.seen[kSeen];
  commands.render({.colors = {{&seen.albedo, 0, std::nullopt}},
                   .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt}},
                  [&] {
                    for (const SeenSky& sky : skies_.all()) {
                      SkyConstants constants = constants_;
                      constants.sight = sky.sight;
                      constants.levels = sky.levels->count();
                      commands.draw(programs_[kSkyOpen], 3, 1, constants,
                                    {{"sky", maps_.at(sky.map)},
                                     {"receiverPosition", seen.position},
                                     {"casterPosition", seen.position},
                                     {"casterNormal", seen.position},
                                     {"casterDirection", seen.position}});
                    }
                  });
}

void SkyPass::record(gpu::CommandList& commands, uint32_t way, const CasterSight& caster,
                     const SeenImages& seen) const {
  commands.render({.colors = {{&seen.albedo, 0, std::nullopt}}, .region = caster.region}, [&] {
    for (const SeenSky& sky : skies_.all()) {
      SkyConstants constants = constants_;
      constants.sight = sky.sight;
      constants.levels = sky.levels->count();
      constants.number = caster.number;
      commands.draw(programs_[way], 3, 1, constants,
                    {{"sky", maps_.at(sky.map)},
                     {"receiverPosition", seen.position},
                     {"casterPosition", caster.position},
                     {"casterNormal", caster.normal},
                     {"casterDirection", caster.direction}});
    }
  });
}

}  // namespace nephroid
