#include "render/sight/rays/ray_sight.h"

#include <algorithm>
#include <array>

#include "geometry/bounds.h"
#include "shaders/render/sight/rays/caster_pixels_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr VkFormat kRanges = VK_FORMAT_R32G32_UINT;

}  // namespace

RaySight::RaySight(gpu::Device& device, bool hasTurbidWater)
    : device_(device),
      hasTurbidWater_(hasTurbidWater),
      program_(gpu::createRasterProgram(device, "casters' pixels", shaders::techniques_whole_picture_vert,
                                        shaders::render_sight_rays_caster_pixels_frag,
                                        {.colors = {{kFormat}, {kFormat}},
                                         .depthFormat = VK_FORMAT_D32_SFLOAT,
                                         .depthCompare = VK_COMPARE_OP_ALWAYS})) {
  ensureImages(uvec2(1));
}

void RaySight::update(SceneTransport& transport, const View& view, uvec2 pictureSize,
                      const std::vector<MeshExtent>& extents, const SkyPass& sky) {
  const Scene& scene = transport.scene();
  std::vector<gpu::Region> regions;
  for (const Object& object : scene.objects) {
    if (!scene.isCaster(object)) continue;
    const gpu::Region region =
        regionOf(view, pictureSize, placedCorners(extents[object.mesh].box, object.placement));
    if (region.size.x > 0) regions.push_back(region);
  }
  const std::vector<const Material*> materials = materialsOf(scene);
  RaySightInput input{scene, transport.rayScene(), materials, view, {}, pictureSize, regions};
  input.trees.tellsWaysBeyond = hasTurbidWater_;
  input.trees.tellsSky = sky.isSeen();
  input.skies = &sky.skies();
  input.sampleSpacing = sky.spacing();
  input.media = mediaAround(transport.rayScene(), materials, view.eye);
  seeByRays(input, seen_);
  // The points' last row is full.
  for (std::vector<vec4>* list : {&seen_.positions, &seen_.normals, &seen_.factors})
    list->resize(std::size_t(rows()) * kPointsInRow, vec4(0));
  ensureImages(pictureSize);
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
    if (hasTurbidWater_) {
      casterPositions_ = picture("casters' positions", kFormat);
      exits_ = picture("ways beyond casters' surfaces", kFormat);
      directions_ = picture("directions beyond casters' surfaces", kFormat);
    }
  }
  if (positions_ && positions_.height() >= rows()) return;
  // A few more, so that a list that grows a little is not made anew in each frame. The old ones go first.
  const uint32_t height = std::max(rows() + rows() / 8, 1u);
  for (gpu::Image* image : {&positions_, &normals_, &factors_, &directLux_, &causticsLux_}) *image = {};
  const auto points = [&](const char* name) {
    return gpu::createImage(device_, name, {.format = kFormat, .width = kPointsInRow, .height = height});
  };
  positions_ = points("positions of sight");
  normals_ = points("normals of sight");
  factors_ = points("factors of sight");
  directLux_ = points("direct lux of sight");
  causticsLux_ = points("caustics lux of sight");
}

CasterImages RaySight::casterImages() const {
  if (seen_.region.size.x == 0) return {};
  return {&casterPositions_, &exits_, &directions_};
}

// What `record` copies to an image, one after the other.
std::vector<RaySight::Copied> RaySight::copied(const FrameImages& images) const {
  std::vector<Copied> all{{std::as_bytes(std::span(seen_.casterNormals)), &images.casterNormal, seen_.region},
                          {std::as_bytes(std::span(seen_.rest)), &rest_, seen_.region}};
  if (hasTurbidWater_)
    all.insert(all.end(), {{std::as_bytes(std::span(seen_.casterPositions)), &casterPositions_, seen_.region},
                           {std::as_bytes(std::span(seen_.exits)), &exits_, seen_.region},
                           {std::as_bytes(std::span(seen_.directions)), &directions_, seen_.region}});
  if (hasPoints())
    all.insert(all.end(), {{std::as_bytes(std::span(seen_.positions)), &positions_, *points().region},
                           {std::as_bytes(std::span(seen_.normals)), &normals_, *points().region},
                           {std::as_bytes(std::span(seen_.factors)), &factors_, *points().region}});
  // Last, as it is aligned to less.
  all.push_back({std::as_bytes(std::span(seen_.ranges)), &ranges_, seen_.region});
  return all;
}

void RaySight::record(gpu::CommandList& commands, const FrameImages& images) {
  const gpu::Region& region = seen_.region;
  if (region.size.x == 0) return;
  const std::vector<Copied> all = copied(images);
  VkDeviceSize bytes = 0;
  for (const Copied& one : all) bytes += one.bytes.size();
  gpu::ensureBuffer(device_, staging_, "sight by rays", bytes, gpu::MemoryKind::upload);
  commands.pass("casters", [&] {
    VkDeviceSize at = 0;
    for (const Copied& one : all) {
      staging_.writeBytes(one.bytes, at);
      commands.copy(staging_, at, *one.image, one.region);
      at += one.bytes.size();
    }
    commands.barrier();
    commands.render({.colors = {{&images.seen[kSeen].position, 0, std::nullopt},
                                {&images.seen[kSeen].albedo, 0, std::nullopt}},
                     .depth = gpu::DepthAttachment{&images.depth, 0, std::nullopt},
                     .region = region},
                    [&] {
                      commands.draw(program_, 3, 1, gpu::NoConstants{}, {{"sightRest", rest_}});
                    });
  });
}

}  // namespace nephroid
