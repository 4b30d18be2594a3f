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

DirectConstants directConstants(const ShadowedLight& light) {
  DirectConstants constants{};
  constants.emitter = light.emitter;
  constants.samples = light.samples;
  if (light.samples > 1) constants.emitter.direction = light.step;
  if (light.mapCount == 0) return constants;
  const ShadowProjection& projection = light.projection;
  const float width = 2 * projection.halfWidth, depth = projection.farthest - projection.nearest;
  constants.mapX = projection.right / width;
  constants.mapY = projection.up / width;
  constants.aim = projection.aim;
  constants.texelSize = width / float(light.resolution);
  if (light.emitter.type == kEmitterDirectional) {
    constants.mapDepth = projection.forward / depth;
    constants.depthOffset = -projection.nearest / depth;
  } else {
    constants.mapDepth = projection.forward;
    constants.depthScale = projection.farthest / depth;
    constants.depthOffset = -constants.depthScale * projection.nearest;
  }
  return constants;
}

}  // namespace

DirectLight::DirectLight(gpu::Device& device, uint32_t shadowMapSize)
    : device_(device),
      shadowMapSize_(shadowMapSize),
      shadowProgram_(shadowProgram(device, "shadow", VK_CULL_MODE_NONE)),
      closedShadowProgram_(shadowProgram(device, "closed shadow", VK_CULL_MODE_BACK_BIT)),
      sampler_(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST})) {}

DirectLight::ProgramKey DirectLight::keyOf(const ShadowedLight& light) {
  return {light.emitter.type, light.mapCount, light.samples > 1};
}

void DirectLight::update(const Scene& scene, const std::vector<MeshExtent>& extents) {
  lights_ = planShadowMaps(scene, extents, shadowMapSize_);
  objectsToWorld_.clear();
  for (const Object& object : scene.objects) objectsToWorld_.push_back(toWorld(object.placement));
  maps_.resize(lights_.size());
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const ShadowedLight& light = lights_[i];
    const auto layers = std::max<uint32_t>(static_cast<uint32_t>(light.maps.size()), 1);
    if (!maps_[i] || maps_[i].layerCount() < layers || maps_[i].width() != light.resolution)
      maps_[i] = gpu::createImage(device_, "shadow maps",
                                  {.format = VK_FORMAT_D32_SFLOAT,
                                   .width = light.resolution,
                                   .height = light.resolution,
                                   .layers = layers});
    const ProgramKey key = keyOf(light);
    if (!programs_.contains(key))
      programs_[key] =
          gpu::createRasterProgram(device_, "direct light", shaders::whole_picture_vert, shaders::direct_frag,
                                   {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
                                   {{0, key.type}, {1, key.mapCount}, {2, key.isLine}});
  }
}

void DirectLight::recordShadowMaps(gpu::CommandList& commands, const GpuScene& gpuScene) {
  for (std::size_t i = 0; i < lights_.size(); ++i)
    for (uint32_t layer = 0; layer < lights_[i].maps.size(); ++layer) {
      const ShadowMap& map = lights_[i].maps[layer];
      commands.render({.colors = {}, .depth = gpu::DepthAttachment{&maps_[i], layer, 1.0f}}, [&] {
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
        for (std::size_t i = 0; i < lights_.size(); ++i)
          commands.draw(programs_.at(keyOf(lights_[i])), 3, 1, directConstants(lights_[i]),
                        {*points.position, *points.normal, {maps_[i], sampler_}});
      });
}

}  // namespace nephroid
