#include "render/air/shafts.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "gpu/transfer.h"
#include "lights/emitters.h"
#include "scene/air.h"
#include "shaders/render/air/air_vert.h"
#include "shaders/render/air/shafts_frag.h"
#include "shaders/render/air/transmittance_frag.h"

namespace nephroid {
namespace {

constexpr VkFormat kFloats = VK_FORMAT_R32G32B32A32_SFLOAT;
constexpr uint32_t kGlimpseStride = 8;  // pixels
constexpr uint32_t kFewestPlanes = 8, kMostPlanes = 256;
constexpr uint32_t kMostSubplanes = 64;

AirSight airSight(const View& view) {
  const PictureRays rays = raysOf(view);
  return {view.eye, rays.middle, rays.right, rays.down, view.nearest, 0, 1};
}

// Sub-planes find a change of light to within the error, as a part of the ray: 1 / (planes * subplanes).
AirPlanes adaptivePlanes(uint32_t planes, float error) {
  const auto most = static_cast<uint32_t>(std::ceil(1 / (error * float(planes))));
  return {planes, std::min(std::bit_ceil(std::max(most, 1u)), kMostSubplanes), error};
}

// The mean difference over the mean luminance, or half the largest over the largest luminance, where shadows
// fall between planes: whichever is more.
double relativeDifference(const std::vector<vec4>& a, const std::vector<vec4>& b) {
  double difference = 0, sum = 0, largest = 0, peak = 0;
  for (std::size_t i = 0; i < a.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const double away = double(std::abs(a[i][c] - b[i][c])), value = double(b[i][c]);
      difference += away;
      sum += value;
      largest = std::max(largest, away);
      peak = std::max(peak, value);
    }
  return sum > 0 ? std::max(difference / sum, 0.5 * largest / peak) : 0;
}

}  // namespace

Shafts::Shafts(gpu::Device& device, const Scene& scene, uvec2 pictureSize, const ShaftSettings& settings)
    : device_(device), settings_(settings) {
  if (!scene.medium) return;
  phase_ = phaseCode(scene.medium->phase);
  box_.emplace(device, scene);
  sampler_ = gpu::createSampler(device);
  transmittance_ = gpu::createRasterProgram(device, "transmittance of the air", shaders::render_air_air_vert,
                                            shaders::render_air_transmittance_frag, {.colors = {{kFloats}}},
                                            {{"kHasBox", box_->isThere()}});
  lights_ = gpu::createBuffer(device, "air", (emitterRowsOf(scene).size() + 1) * sizeof(AirLight),
                              gpu::MemoryKind::upload);
  resize(pictureSize);
}

void Shafts::resize(uvec2 pictureSize) {
  if (!box_) return;
  image_ = gpu::createImage(device_, "shafts", {.width = pictureSize.x, .height = pictureSize.y});
  glimpse_ = gpu::createImage(device_, "glimpse of shafts",
                              {.width = std::max(pictureSize.x / kGlimpseStride, 1u),
                               .height = std::max(pictureSize.y / kGlimpseStride, 1u)});
}

LightsInAir Shafts::lightsInAir() const {
  if (!image_) return {};
  return {lights_.address(), &box_->depths(), box_->isThere()};
}

void Shafts::update(const Scene& scene, const View& view) {
  if (!image_) return;
  lightCount_ = static_cast<uint32_t>(emitterRowsOf(scene).size());
  air_ = airOf(*scene.medium);
  box_->update(scene);
  sight_ = airSight(view);
  // Planes that were as dense as the densest fog would all stand before an eye above it.
  sight_.pace = air_.extinction * std::max(fogDensity(air_, view.eye.y), 0.02f);
  if (!(sight_.pace > 0)) sight_.pace = 1 / kFarthestAir;
  const uint32_t planes = settings_.planes > 0 ? settings_.planes : kFewestPlanes;
  AirPlanes first = adaptivePlanes(planes, settings_.error);
  if (settings_.subplanes > 0) first = {planes, settings_.subplanes, 0};
  planes_.assign(lightCount_, first);
  for (uint32_t i = 0; i <= lightCount_; ++i) write(i, i, first, 1);
}

void Shafts::look(const View& view) {
  if (!image_) return;
  const float pace = sight_.pace;
  sight_ = airSight(view);
  sight_.pace = pace;
  for (uint32_t light = 0; light < lightCount_; ++light) write(light, light, planes_[light], 1);
}

void Shafts::write(uint32_t index, uint32_t light, const AirPlanes& planes, uint32_t stride) const {
  AirLight data{air_, sight_, planes, box_->of(light)};
  data.sight.stride = stride;
  lights_.as<AirLight>()[index] = data;
}

const gpu::Program& Shafts::program(const ProgramKey& key) {
  gpu::Program& program = programs_[key];
  if (!program) {
    std::vector<gpu::SpecializationConstant> constants = key.specialization();
    constants.push_back({"kPhase", phase_});
    program = gpu::createRasterProgram(device_, "shafts", shaders::render_air_air_vert,
                                       shaders::render_air_shafts_frag,
                                       {.colors = {{kFloats, gpu::Blend::add}}}, constants);
  }
  return program;
}

void Shafts::draw(gpu::CommandList& commands, const DirectLight& directLight, const GpuScene& gpuScene,
                  const gpu::Image& depth, uint32_t light, uint64_t address) {
  DirectConstants constants = directLight.constants(light);
  constants.air = address;
  const auto [map, gobo, profile] = directLight.bindings(light, gpuScene);
  commands.draw(program(directLight.key(light)), 3, 1, constants,
                {{"depthImage", depth},
                 map,
                 gobo,
                 profile,
                 {"boxDepths", box_->depths(), sampler_},
                 {"density", box_->density(), sampler_}});
}

std::vector<vec4> Shafts::glimpse(const DirectLight& directLight, const GpuScene& gpuScene,
                                  const gpu::Image& depth, uint32_t light, const AirPlanes& planes) {
  write(lightCount_, light, planes, kGlimpseStride);
  device_.submitAndWait([&](gpu::CommandList& commands) {
    commands.render({.colors = {{&glimpse_, 0, vec4(0)}}}, [&] {
      draw(commands, directLight, gpuScene, depth, light, lights_.address() + lightCount_ * sizeof(AirLight));
    });
  });
  return gpu::download<vec4>(device_, glimpse_);
}

AirPlanes Shafts::chosenPlanes(const DirectLight& directLight, const GpuScene& gpuScene,
                               const gpu::Image& depth, uint32_t light) {
  const auto with = [&](uint32_t planes) {
    return settings_.subplanes > 0 ? AirPlanes{planes, settings_.subplanes, 0}
                                   : adaptivePlanes(planes, settings_.error);
  };
  uint32_t planes = kFewestPlanes;
  std::vector<vec4> seen = glimpse(directLight, gpuScene, depth, light, with(planes));
  for (; planes < kMostPlanes; planes *= 2) {
    const std::vector<vec4> finer = glimpse(directLight, gpuScene, depth, light, with(2 * planes));
    // Where light changes at once, as at most gobos, half as far from plane to plane is half the error.
    const double change = relativeDifference(seen, finer);
    if (2 * change <= double(settings_.error)) break;
    if (change <= double(settings_.error)) return with(2 * planes);
    seen = finer;
  }
  return with(planes);
}

void Shafts::choosePlanes(const DirectLight& directLight, const GpuScene& gpuScene, const gpu::Image& depth) {
  if (!image_ || settings_.planes > 0) return;
  for (uint32_t light = 0; light < lightCount_; ++light) {
    planes_[light] = chosenPlanes(directLight, gpuScene, depth, light);
    write(light, light, planes_[light], 1);
  }
}

void Shafts::record(gpu::CommandList& commands, const DirectLight& directLight, const GpuScene& gpuScene,
                    const gpu::Image& depth) {
  if (!image_) return;
  commands.render({.colors = {{&image_, 0, vec4(0)}}}, [&] {
    commands.draw(transmittance_, 3, 1, lights_.address(),
                  {{"depthImage", depth}, {"boxDepths", box_->depths(), sampler_}});
    for (uint32_t light = 0; light < lightCount_; ++light)
      draw(commands, directLight, gpuScene, depth, light, lights_.address() + light * sizeof(AirLight));
  });
}

}  // namespace nephroid
