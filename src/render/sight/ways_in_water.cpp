#include "render/sight/ways_in_water.h"

#include <algorithm>

#include "geometry/bounds.h"
#include "render/sight/view_rays.h"
#include "scene/volume.h"
#include "shaders/render/sight/ways_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr VkFormat kWayFormat = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr float kFarthestWay = 1e5f;  // m in water, where nothing is met

}  // namespace

WaysInWater::WaysInWater(gpu::Device& device, bool isByRays)
    : program_(gpu::createRasterProgram(
          device, "ways in water", shaders::techniques_whole_picture_vert, shaders::render_sight_ways_frag,
          {.colors = {{kWayFormat}, {kWayFormat}}}, {{"kIsByRays", isByRays}})) {}

void WaysInWater::update(const SceneTransport& transport, const View& view, uvec2 pictureSize,
                         const std::vector<MeshExtent>& extents, const gpu::Region& casterRegion) {
  waters_.clear();
  const Scene& scene = transport.scene();
  const MediumStack media = transport.mediaAround(sightQuery(0, view.eye, 0, {}).emitter);
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    if (!object.water || !scene.isCaster(object)) continue;
    const gpu::Region region =
        regionOf(view, pictureSize, placedCorners(extents[object.mesh].box, object.placement));
    add(scene, view, i, pictureSize, media.top() == i, region.size.x > 0);
  }
  for (WaterInSight& water : waters_)
    water.constants.region =
        uvec4(casterRegion.corner.x, casterRegion.corner.y, casterRegion.size.x, casterRegion.size.y);
  std::ranges::stable_sort(waters_, {}, [](const WaterInSight& water) { return water.constants.kind; });
}

void WaysInWater::add(const Scene& scene, const View& view, uint32_t object, uvec2 pictureSize, bool isInside,
                      bool isInPicture) {
  const Material& material = scene.materialOf(scene.objects[object]);
  const vec3 extinction = extinctionOf(material);
  if (extinction == vec3(0) || !(isInside || isInPicture)) return;
  const PictureRays rays = raysOf(view);
  WayConstants constants{};
  constants.eye = view.eye;
  constants.middle = rays.middle;
  constants.right = rays.right;
  constants.down = rays.down;
  constants.imageSize = vec2(pictureSize);
  constants.number = object + 1;
  constants.ior = material.ior.y;
  constants.farthest = kFarthestWay;
  const auto addWays = [&](uint kind) {
    constants.kind = kind;
    waters_.push_back({object, constants, extinction});
  };
  if (isInPicture) addWays(isInside ? kWayReflected : kWayFromSurface);
  if (isInside) addWays(kWayFromEye);
}

vec3 WaysInWater::extinctionAtEye() const {
  return !waters_.empty() && waters_.back().constants.kind == kWayFromEye ? waters_.back().extinction
                                                                          : vec3(0);
}

void WaysInWater::record(gpu::CommandList& commands, const WaterInSight& water, const FrameImages& images,
                         const CasterImages& casters, const gpu::Image& start, const gpu::Image& direction) {
  const gpu::Image& none = images.seen[kSeen].position;
  commands.render({.colors = {{&start, 0, std::nullopt}, {&direction, 0, std::nullopt}}}, [&] {
    commands.draw(program_, 3, 1, water.constants,
                  {{"receiverPosition", images.seen[kSeen].position},
                   {"casterPosition", casters.position ? *casters.position : none},
                   {"casterNormal", casters.position ? images.casterNormal : none},
                   {"casterExit", casters.exit ? *casters.exit : none},
                   {"casterDirection", casters.direction ? *casters.direction : none}});
  });
}

}  // namespace nephroid
