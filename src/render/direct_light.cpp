#include "render/direct_light.h"

#include <algorithm>
#include <optional>

#include "gpu/transfer.h"
#include "lights/emitters.h"
#include "lights/light_intensity.h"
#include "shaders/render/air/air_vert.h"
#include "shaders/render/direct_frag.h"
#include "shaders/render/shadow_vert.h"
#include "shaders/render/shadows/lamps_frag.h"

namespace nephroid {
namespace {

gpu::Program shadowProgram(gpu::Device& device, const char* name, VkCullModeFlags cull) {
  gpu::RasterState state;
  state.depthFormat = VK_FORMAT_D32_SFLOAT;
  state.cull = cull;
  state.frontFace = VK_FRONT_FACE_CLOCKWISE;  // maps are seen with y up
  return gpu::createRasterProgram(device, name, shaders::render_shadow_vert, {}, state);
}

mat4 toWorld(const Placement& placement) {
  mat4 map = placement.scale * mat4(glm::mat3_cast(placement.rotation));
  map[3] = vec4(placement.translation, 1);
  return map;
}

// As direct.frag reads it.
gpu::Image profileImage(gpu::Device& device, const Profile& profile) {
  const auto width = static_cast<uint32_t>(profile.verticalAngles.size()) + 1;
  const auto height = static_cast<uint32_t>(profile.horizontalAngles.size()) + 1;
  std::vector<float> texels(std::size_t{width} * height);
  std::ranges::copy(profile.verticalAngles, texels.begin() + 1);
  for (std::size_t h = 0; h + 1 < height; ++h) {
    float* row = texels.data() + (h + 1) * width;
    row[0] = profile.horizontalAngles[h];
    std::copy_n(profile.fractions.data() + h * (width - 1), width - 1, row + 1);
  }
  gpu::Image image = gpu::createImage(device, "profile " + profile.name,
                                      {.format = VK_FORMAT_R32_SFLOAT, .width = width, .height = height});
  const auto bytes = std::as_bytes(std::span(texels));
  gpu::uploadImage(device, image, {{bytes.begin(), bytes.end()}});
  return image;
}

}  // namespace

DirectLight::DirectLight(gpu::Device& device, const Scene& scene, uint32_t shadowMapSize)
    : device_(device),
      shadowMapSize_(shadowMapSize),
      shadowProgram_(shadowProgram(device, "shadow", VK_CULL_MODE_NONE)),
      closedShadowProgram_(shadowProgram(device, "closed shadow", VK_CULL_MODE_BACK_BIT)),
      sampler_(gpu::createSampler(device, {.filter = VK_FILTER_NEAREST})),
      goboSampler_(gpu::createSampler(device)) {
  for (const Profile& profile : scene.profiles) profiles_.push_back(profileImage(device, profile));
  profiles_.push_back(profileImage(device, {"none", PhotometryType::c, {0, 180}, {0}, {0, 0}, 0}));
  none_ = gpu::createImage(device, "nothing", {.format = VK_FORMAT_R8_UNORM, .layers = 1});
}

DirectLight::DrawnLight DirectLight::drawn(const Scene& scene, ShadowedLight shadowed) {
  const Light& light = scene.lights[shadowed.row.first.light];
  DrawnLight drawn{std::move(shadowed), {}, light.type == LightType::sky, kNone, kNone, vec2(0)};
  drawn.key = {.type = drawn.shadowed.row.first.type,
               .mapCount = drawn.shadowed.mapCount,
               .isLine = drawn.shadowed.row.count > 1};
  if (light.type != LightType::spot) return drawn;
  drawn.gobo = light.goboTexture;
  drawn.profile = light.profile;
  drawn.goboTurn = shapedLight(scene, light).goboTurn;
  drawn.key.hasGobo = drawn.gobo != kNone;
  if (drawn.profile != kNone)
    drawn.key.profileType = static_cast<uint32_t>(scene.profiles[drawn.profile].type);
  return drawn;
}

std::vector<gpu::SpecializationConstant> DirectLight::ProgramKey::specialization() const {
  return {{"kEmitterType", type}, {"kMapCount", mapCount},       {"kIsLine", isLine},
          {"kHasGobo", hasGobo},  {"kProfileType", profileType}, {"kHasAir", hasAir},
          {"kHasBox", hasAirBox}};
}

DirectConstants DirectLight::constants(uint32_t index) const {
  const DrawnLight& drawn = lights_[index];
  const ShadowedLight& light = drawn.shadowed;
  DirectConstants constants{};
  if (air_.lights != 0) constants.air = air_.lights + index * sizeof(AirLight);
  constants.position = light.row.first.position;
  constants.direction = light.row.count > 1 ? light.row.step : light.row.first.direction;
  constants.power = light.row.first.power;
  constants.coneScale = light.row.first.coneScale;
  constants.coneOffset = light.row.first.coneOffset;
  constants.samples = light.row.count;
  constants.goboTurn = drawn.goboTurn;
  if (light.mapCount == 0) return constants;
  const ShadowProjection& projection = light.projection;
  const float width = 2 * projection.halfWidth, depth = projection.farthest - projection.nearest;
  constants.mapX = projection.right / width;
  constants.mapY = projection.up / width;
  constants.aim = projection.aim;
  constants.texelSize = width / float(light.resolution);
  if (light.row.first.type == kEmitterDirectional) {
    constants.mapDepth = projection.forward / depth;
    constants.depthOffset = -projection.nearest / depth;
  } else {
    constants.mapDepth = projection.forward;
    constants.depthScale = projection.farthest / depth;
    constants.depthOffset = -constants.depthScale * projection.nearest;
  }
  return constants;
}

void DirectLight::update(const Scene& scene, const std::vector<MeshExtent>& extents, const LightsInAir& air,
                         const LampShadows& shadows) {
  air_ = air;
  shadows_ = &shadows;
  objectsToWorld_.clear();
  for (const Object& object : scene.objects) objectsToWorld_.push_back(toWorld(object.placement));
  lights_.clear();
  for (ShadowedLight& light : planShadowMaps(scene, extents, shadowMapSize_))
    lights_.push_back(drawn(scene, std::move(light)));
  maps_.resize(lights_.size());
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    ShadowedLight& light = lights_[i].shadowed;
    ProgramKey& key = lights_[i].key;
    const bool isSky = lights_[i].isOfSky;
    if (!isSky && air.lights == 0) {  // nothing reads its maps
      light.maps.clear();
      light.mapCount = key.mapCount = 0;
      light.resolution = 1;
    }
    const auto layers = std::max<uint32_t>(static_cast<uint32_t>(light.maps.size()), 1);
    if (!maps_[i] || maps_[i].layerCount() < layers || maps_[i].width() != light.resolution)
      maps_[i] = gpu::createImage(device_, "shadow maps",
                                  {.format = VK_FORMAT_D32_SFLOAT,
                                   .width = light.resolution,
                                   .height = light.resolution,
                                   .layers = layers});
    key.hasAir = air.lights != 0;
    key.hasAirBox = air.hasBox;
    if (isSky && !programs_.contains(key))
      programs_[key] = gpu::createRasterProgram(
          device_, "direct light", shaders::render_air_air_vert, shaders::render_direct_frag,
          {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}}, key.specialization());
  }
  addLamps(scene, shadows);
}

namespace {

uint32_t formOf(const Light& light) {
  switch (light.type) {
    case LightType::directional:
      return kLampAfar;
    case LightType::spot:
      return kLampSpot;
    case LightType::area:
      return kLampPanel;
    case LightType::line:
      return kLampLine;
    default:
      return kLampBall;
  }
}

LampConstants lampConstants(const Light& light) {
  const Emitter lamp = lampOf(light);
  LampConstants constants{};
  constants.position = light.position;
  constants.radius =
      light.type == LightType::directional ? std::sin(glm::radians(0.5f * light.angle)) : light.radius;
  constants.direction = light.direction;
  constants.coneScale = lamp.coneScale;
  constants.coneOffset = lamp.coneOffset;
  constants.power = lamp.power;
  constants.u = light.type == LightType::line ? light.end - light.position : light.u;
  constants.v = light.v;
  return constants;
}

}  // namespace

void DirectLight::addLamps(const Scene& scene, const LampShadows& shadows) {
  lamps_.clear();
  uint32_t firstRow = 0;
  for (const Light& light : scene.lights) {
    const auto rows = uint32_t(emitterRowsOf(light).size());
    if (light.type != LightType::sky) {
      DrawnLamp lamp{{}, lampConstants(light), firstRow + rows / 2};
      const DrawnLight& drawn = lights_[lamp.light];
      lamp.constants.goboTurn = drawn.goboTurn;
      if (air_.lights != 0) lamp.constants.air = air_.lights + lamp.light * sizeof(AirLight);
      lamp.key = {formOf(light),
                  lamp.constants.radius > 0,
                  shadows.hasShadows(uint32_t(lamps_.size())),
                  drawn.key.hasGobo,
                  drawn.key.profileType,
                  drawn.key.hasAir && light.type != LightType::directional,
                  drawn.key.hasAirBox};
      if (!lampPrograms_.contains(lamp.key))
        lampPrograms_[lamp.key] = gpu::createRasterProgram(
            device_, "light of a lamp", shaders::render_air_air_vert, shaders::render_shadows_lamps_frag,
            {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}},
            {{"kForm", lamp.key.form},
             {"kHasRadius", lamp.key.hasRadius},
             {"kHasShadows", lamp.key.hasShadows},
             {"kHasGobo", lamp.key.hasGobo},
             {"kProfileType", lamp.key.profileType},
             {"kHasAir", lamp.key.hasAir},
             {"kHasBox", lamp.key.hasAirBox}});
      lamps_.push_back(lamp);
    }
    firstRow += rows;
  }
}

void DirectLight::recordShadowMaps(gpu::CommandList& commands, const GpuScene& gpuScene) {
  for (std::size_t i = 0; i < lights_.size(); ++i) {
    const std::vector<ShadowMap>& maps = lights_[i].shadowed.maps;
    for (uint32_t layer = 0; layer < maps.size(); ++layer)
      commands.render({.colors = {}, .depth = gpu::DepthAttachment{&maps_[i], layer, 1.0f}}, [&] {
        for (const ShadowCaster& caster : maps[layer].casters)
          commands.drawIndexed(
              caster.hidesItsFarSide ? closedShadowProgram_ : shadowProgram_, gpuScene.indices(),
              gpuScene.draws()[caster.object].range, 1,
              ShadowConstants{gpuScene.vertices(), maps[layer].worldToMap * objectsToWorld_[caster.object]});
      });
  }
}

void DirectLight::drawLamp(gpu::CommandList& commands, const GpuScene& gpuScene, const ReceiverPoints& points,
                           uint32_t view, uint32_t index) {
  const DrawnLamp& lamp = lamps_[index];
  const auto [map, gobo, profile] = bindings(lamp.light, gpuScene);
  commands.draw(lampPrograms_.at(lamp.key), 3, 1, lamp.constants,
                {{"receiverPosition", *points.position},
                 {"receiverNormal", *points.normal},
                 {"seenParts", lamp.key.hasShadows ? shadows_->parts(view, index) : gpuScene.texture(kNone)},
                 gobo,
                 profile,
                 {"boxDepths", air_.depths ? *air_.depths : none_, goboSampler_}});
}

void DirectLight::record(gpu::CommandList& commands, const GpuScene& gpuScene, uint32_t view,
                         const ReceiverPoints& points, const gpu::Image& lux) {
  commands.render({.colors = {{&lux, 0, vec4(0)}}, .region = points.region}, [&] {
    for (uint32_t i = 0; i < lamps_.size(); ++i) drawLamp(commands, gpuScene, points, view, i);
    for (uint32_t i = 0; i < lightCount(); ++i) {
      if (!lights_[i].isOfSky) continue;
      const auto [map, gobo, profile] = bindings(i, gpuScene);
      commands.draw(programs_.at(key(i)), 3, 1, constants(i),
                    {{"receiverPosition", *points.position},
                     {"receiverNormal", *points.normal},
                     map,
                     gobo,
                     profile,
                     {"boxDepths", air_.depths ? *air_.depths : none_, goboSampler_}});
    }
  });
}

std::vector<const gpu::Image*> DirectLight::shadowMaps() const {
  std::vector<const gpu::Image*> maps;
  for (uint32_t i = 0; i < lightCount(); ++i)
    if (!lights_[i].shadowed.maps.empty()) maps.push_back(&maps_[i]);
  return maps;
}

std::array<gpu::Binding, 3> DirectLight::bindings(uint32_t light, const GpuScene& gpuScene) const {
  const DrawnLight& drawn = lights_[light];
  const std::size_t profile = std::min<std::size_t>(drawn.profile, profiles_.size() - 1);
  return {gpu::Binding("shadowMaps", maps_[light], sampler_),
          gpu::Binding("gobo", gpuScene.texture(drawn.gobo), goboSampler_),
          gpu::Binding("profile", profiles_[profile], sampler_)};
}

}  // namespace nephroid
