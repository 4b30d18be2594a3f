#include "render/direct_light.h"

#include <algorithm>
#include <optional>

#include "render/frame_data.h"
#include "shaders/direct_frag.h"
#include "shaders/shadow_vert.h"
#include "shaders/whole_picture_vert.h"

namespace nephroid {
namespace {

gpu::Program shadowProgram(gpu::Device& device, const char* name, VkCullModeFlags cull) {
  gpu::RasterState state;
  state.depthFormat = VK_FORMAT_D32_SFLOAT;
  state.cull = cull;
  state.frontFace = VK_FRONT_FACE_CLOCKWISE;  // maps are seen with y up
  return gpu::createRasterProgram(device, name, shaders::shadow_vert, {}, state);
}

mat4 toWorld(const Placement& placement) {
  mat4 map = placement.scale * mat4(glm::mat3_cast(placement.rotation));
  map[3] = vec4(placement.translation, 1);
  return map;
}

DirectConstants directConstants(const ShadowPlan& plan, const ShadowedEmitter& lit) {
  DirectConstants constants{};
  constants.emitter = lit.emitter;
  constants.texelSize = lit.texelSize;
  constants.texelSizePerDepth = lit.texelSizePerDepth;
  constants.firstMap = lit.firstMap;
  if (lit.mapCount == 0) return constants;
  // In a perspective the third row is depthScale times the fourth, and depthOffset.
  const mat4 rows = glm::transpose(plan.maps[lit.firstMap].worldToMap);
  constants.mapX = rows[0];
  constants.mapY = rows[1];
  constants.mapDepth = rows[2];
  if (lit.texelSizePerDepth > 0) {
    constants.mapDepth = rows[3];
    constants.depthScale = dot(vec3(rows[2]), vec3(rows[3])) / dot(vec3(rows[3]), vec3(rows[3]));
    constants.depthOffset = rows[2].w - constants.depthScale * rows[3].w;
  }
  return constants;
}

}  // namespace

DirectLight::DirectLight(gpu::Device& device, uint32_t shadowMapSize)
    : device_(device),
      shadowMapSize_(shadowMapSize),
      shadowProgram_(shadowProgram(device, "shadow", VK_CULL_MODE_NONE)),
      closedShadowProgram_(shadowProgram(device, "closed shadow", VK_CULL_MODE_BACK_BIT)),
      sampler_(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST})) {
  for (const uint32_t type : {kEmitterDirectional, kEmitterPoint, kEmitterSpot})
    for (const uint32_t maps : {0u, 1u, 6u})
      programs_[{type, maps}] = gpu::createRasterProgram(
          device, "direct", shaders::whole_picture_vert, shaders::direct_frag,
          {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}}, {{0, type}, {1, maps}});
}

void DirectLight::update(const Scene& scene, const std::vector<MeshExtent>& extents) {
  plan_ = planShadowMaps(scene, extents, shadowMapSize_);
  objectsToWorld_.clear();
  for (const Object& object : scene.objects) objectsToWorld_.push_back(toWorld(object.placement));
  const auto layers = std::max<uint32_t>(static_cast<uint32_t>(plan_.maps.size()), 1);
  if (!maps_ || maps_.layerCount() < layers)
    maps_ = gpu::createImage(device_, "shadow maps",
                             {.format = VK_FORMAT_D32_SFLOAT,
                              .width = shadowMapSize_,
                              .height = shadowMapSize_,
                              .layers = layers});
}

void DirectLight::recordShadowMaps(gpu::CommandList& commands, const GpuScene& gpuScene) {
  for (uint32_t layer = 0; layer < plan_.maps.size(); ++layer) {
    const ShadowMap& map = plan_.maps[layer];
    commands.render({.colors = {}, .depth = gpu::DepthAttachment{&maps_, layer, 1.0f}}, [&] {
      for (const ShadowCaster& caster : map.casters)
        commands.drawIndexed(
            caster.hidesItsFarSide ? closedShadowProgram_ : shadowProgram_, gpuScene.indices(),
            gpuScene.draws()[caster.object].range, 1,
            ShadowConstants{gpuScene.vertices(), map.worldToMap * objectsToWorld_[caster.object]});
    });
  }
}

void DirectLight::record(gpu::CommandList& commands, const ReceiverPoints& points, const gpu::Image& lux) {
  const bool isAll = points.region.size.x == 0 || points.region.size.y == 0;
  commands.render(
      {.colors = {{&lux, 0, vec4(0)}}, .region = isAll ? std::nullopt : std::optional(points.region)}, [&] {
        for (const ShadowedEmitter& lit : plan_.emitters)
          commands.draw(programs_.at({lit.emitter.type, lit.mapCount}), 3, 1, directConstants(plan_, lit),
                        {*points.position, *points.normal, {maps_, sampler_}});
      });
}

}  // namespace nephroid
