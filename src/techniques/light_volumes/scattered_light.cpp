#include "techniques/light_volumes/scattered_light.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <limits>

#include "gpu/command_list.h"
#include "scene/volume.h"
#include "shaders/techniques/light_volumes/scatter_frag.h"
#include "shaders/techniques/whole_picture_vert.h"

namespace nephroid {
namespace {

constexpr float kDark = 7;  // optical depth past which nothing is to be seen

float farthestIn(vec3 extinction) {
  const float least = std::min({extinction.x, extinction.y, extinction.z});
  return least > 0 ? std::min(kDark / least, LayerSettings{}.farthest) : LayerSettings{}.farthest;
}

// m along unit `axis`, of the object's surface.
float reliefOf(const Scene& scene, uint32_t index, vec3 axis) {
  const Object& object = scene.objects[index];
  const vec3 own = object.placement.inverseDirection(axis);
  float low = std::numeric_limits<float>::max(), high = -low;
  for (const vec3& position : scene.meshOf(object).positions) {
    low = std::min(low, dot(own, position));
    high = std::max(high, dot(own, position));
  }
  return object.placement.scale * (high - low);
}

float meanOf(const std::vector<vec4>& texels) {
  double sum = 0;
  for (const vec4& texel : texels) sum += double(texel.x);
  return float(sum / double(texels.size()));
}

}  // namespace

ScatteredLight::ScatteredLight(gpu::Device& device)
    : device_(device),
      program_(gpu::createRasterProgram(device, "light in water", shaders::techniques_whole_picture_vert,
                                        shaders::techniques_light_volumes_scatter_frag,
                                        {.colors = {{VK_FORMAT_R32G32B32A32_SFLOAT, gpu::Blend::add}}})),
      sampler_(gpu::createSampler(device)) {}

void ScatteredLight::add(const Scene& scene, uint32_t object, std::span<const Beam> beams, vec3 axis) {
  const Material& material = scene.materialOf(scene.objects[object]);
  const vec3 extinction = extinctionOf(material);
  LayerSettings settings;
  settings.farthest = farthestIn(extinction);
  settings.relief = reliefOf(scene, object, axis);
  const LightLayers light = lightInLayers(beams, axis, settings);
  if (light.texels.empty()) return;
  const float scale = meanOf(light.texels);
  if (!(scale > 0)) return;
  if (portions_.size() == count_) portions_.emplace_back();
  Portion& portion = portions_[count_++];
  portion.object = object;
  portion.constants = {light.grid, scale * material.scattering * light.color, extinction,
                       phaseCode(material.phase), material.g};
  write(portion, light, scale);
}

// Half floats hold what is between a sixteen-thousandth and sixty-five thousand times the mean.
void ScatteredLight::write(Portion& portion, const LightLayers& light, float scale) {
  const auto width = uint32_t(light.grid.size.x), height = uint32_t(light.grid.size.y),
             layers = uint32_t(light.grid.layers);
  if (!portion.layers || uvec3(portion.layers.width(), portion.layers.height(),
                               portion.layers.layerCount()) != uvec3(width, height, layers))
    portion.layers = gpu::createImage(
        device_, "light in water",
        {.format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = width, .height = height, .layers = layers});
  gpu::ensureBuffer(device_, portion.staged, "light in water", light.texels.size() * sizeof(uint64_t),
                    gpu::MemoryKind::upload);
  constexpr float kMost = 65000;
  std::ranges::transform(light.texels, portion.staged.as<uint64_t>().begin(), [&](const vec4& texel) {
    return glm::packHalf4x16(glm::clamp(texel / scale, -kMost, kMost));
  });
}

void ScatteredLight::upload(gpu::CommandList& commands) const {
  for (const Portion& portion : std::span(portions_).first(count_)) {
    const std::size_t layerBytes =
        std::size_t{portion.layers.width()} * portion.layers.height() * sizeof(uint64_t);
    for (uint32_t layer = 0; layer < portion.layers.layerCount(); ++layer)
      commands.copy(portion.staged, layer * layerBytes, portion.layers, layer);
  }
}

void ScatteredLight::draw(gpu::CommandList& commands, const WaysOfSight& ways,
                          const gpu::Image& luminance) const {
  for (const Portion& portion : std::span(portions_).first(count_)) {
    if (portion.object != ways.object) continue;
    commands.pass("light in water", [&] {
      commands.render({.colors = {{&luminance, 0, std::nullopt}}, .region = ways.region}, [&] {
        commands.draw(program_, 3, 1, portion.constants,
                      {{"wayStart", *ways.start},
                       {"wayDirection", *ways.direction},
                       {"layers", portion.layers, sampler_}});
      });
    });
  }
}

}  // namespace nephroid
