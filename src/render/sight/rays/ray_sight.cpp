#include "render/sight/rays/ray_sight.h"

#include <algorithm>
#include <array>

#include "shaders/render/sight/rays/caster_pixels_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kRanges = VK_FORMAT_R32G32_UINT;

}  // namespace

RaySight::RaySight(gpu::Device& device)
    : device_(device),
      program_(gpu::createRasterProgram(device, "casters' pixels", shaders::techniques_whole_picture_vert,
                                        shaders::render_sight_rays_caster_pixels_frag,
                                        {.colors = {{kFormat}, {kFormat}},
                                         .depthFormat = VK_FORMAT_D32_SFLOAT,
                                         .depthCompare = VK_COMPARE_OP_ALWAYS})) {
  ensureImages(uvec2(1));
}

void RaySight::update(SceneTransport& transport, const View& view, uvec2 pictureSize,
                      const std::vector<MeshExtent>& extents) {
  const Scene& scene = transport.scene();
  std::vector<gpu::Region> regions;
  for (const Object& object : scene.objects) {
    if (!scene.isCaster(object)) continue;
    const gpu::Region region =
        regionOf(view, pictureSize, placedCorners(extents[object.mesh].box, object.placement));
    if (region.size.x > 0) regions.push_back(region);
  }
  const std::vector<const Material*> materials = materialsOf(scene);
  RaySightInput input{scene, transport.rayScene(), materials, view, {}, pictureSize, regions, {}, true};
  input.media = mediaAround(transport.rayScene(), materials, view.eye);
  seeByRays(input, seen_);
  ensureImages(pictureSize);
  upload();
}

uint32_t RaySight::rows() const {
  return (uint32_t(seen_.positions.size()) + kPointsInRow - 1) / kPointsInRow;
}

ReceiverPoints RaySight::points() const {
  return {&positions_, &normals_, gpu::Region{{0, 0}, {kPointsInRow, rows()}}};
}

void RaySight::ensureImages(uvec2 pictureSize) {
  if (!rest_ || uvec2(rest_.width(), rest_.height()) != pictureSize) {
    const auto picture = [&](const char* name, VkFormat format) {
      return gpu::createImage(device_, name,
                              {.format = format, .width = pictureSize.x, .height = pictureSize.y});
    };
    rest_ = picture("what casters show by no light", kFormat);
    ranges_ = picture("ranges of points of sight", kRanges);
  }
  if (positions_ && positions_.height() >= rows()) return;
  // Half as many more, so that a list that grows a little is not made anew in each frame.
  const uint32_t height = std::max(rows() + rows() / 2, 1u);
  const auto points = [&](const char* name) {
    return gpu::createImage(device_, name, {.format = kFormat, .width = kPointsInRow, .height = height});
  };
  positions_ = points("positions of sight");
  normals_ = points("normals of sight");
  factors_ = points("factors of sight");
  directLux_ = points("direct lux of sight");
  causticsLux_ = points("caustics lux of sight");
}

// In the order in which `record` copies it.
void RaySight::upload() {
  // The points' last row is full.
  for (std::vector<vec4>* list : {&seen_.positions, &seen_.normals, &seen_.factors})
    list->resize(std::size_t(rows()) * kPointsInRow, vec4(0));
  const std::size_t pixels = seen_.rest.size(), points = seen_.positions.size();
  gpu::ensureBuffer(device_, staging_, "sight by rays",
                    pixels * (2 * sizeof(vec4) + sizeof(uvec2)) + points * 3 * sizeof(vec4),
                    gpu::MemoryKind::upload);
  VkDeviceSize at = 0;
  for (const std::vector<vec4>* list :
       {&seen_.casterNormals, &seen_.rest, &seen_.positions, &seen_.normals, &seen_.factors}) {
    staging_.write(*list, at);
    at += list->size() * sizeof(vec4);
  }
  staging_.write(seen_.ranges, at);
}

void RaySight::record(gpu::CommandList& commands, const FrameImages& images) {
  const gpu::Region& region = seen_.region;
  if (region.size.x == 0) return;
  commands.pass("casters", [&] {
    VkDeviceSize at = 0;
    for (const gpu::Image* image : {&images.casterNormal, static_cast<const gpu::Image*>(&rest_)}) {
      commands.copy(staging_, at, *image, region);
      at += seen_.rest.size() * sizeof(vec4);
    }
    for (const gpu::Image* image : {&positions_, &normals_, &factors_}) {
      if (hasPoints()) commands.copy(staging_, at, *image, *points().region);
      at += seen_.positions.size() * sizeof(vec4);
    }
    commands.copy(staging_, at, ranges_, region);
    commands.barrier();
    commands.render({.colors = {{&images.seen[kSeen].position, 0, std::nullopt},
                                {&images.seen[kSeen].albedo, 0, std::nullopt}},
                     .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt},
                     .region = region},
                    [&] { commands.draw(program_, 3, 1, gpu::NoConstants{}, {{"sightRest", rest_}}); });
  });
}

}  // namespace nephroid
