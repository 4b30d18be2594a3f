#include "render/air/density_box.h"

#include <glm/gtc/packing.hpp>

#include "gpu/transfer.h"
#include "lights/emitters.h"
#include "shaders/render/air/box_depths_comp.h"

namespace nephroid {
namespace {

// At least two layers, between which shaders interpolate.
gpu::Image densityImage(gpu::Device& device, const DensityGrid& grid) {
  const uint32_t layers = std::max(grid.cells.z, 2u);
  gpu::Image image = gpu::createImage(
      device, "density of the air",
      {.format = VK_FORMAT_R16_SFLOAT, .width = grid.cells.x, .height = grid.cells.y, .layers = layers});
  const std::size_t layerTexels = std::size_t{grid.cells.x} * grid.cells.y;
  const std::size_t layerBytes = (layerTexels * sizeof(uint16_t) + 3) / 4 * 4;
  const gpu::Buffer staged =
      gpu::createBuffer(device, "density of the air", layers * layerBytes, gpu::MemoryKind::upload);
  for (uint32_t layer = 0; layer < layers; ++layer) {
    const float* values = grid.densities.data() + std::min(layer, grid.cells.z - 1) * layerTexels;
    const auto halves = staged.as<uint16_t>().subspan(layer * layerBytes / 2, layerTexels);
    for (std::size_t i = 0; i < layerTexels; ++i) halves[i] = glm::packHalf1x16(values[i]);
  }
  device.submitAndWait([&](gpu::CommandList& commands) {
    for (uint32_t layer = 0; layer < layers; ++layer) commands.copy(staged, layer * layerBytes, image, layer);
  });
  return image;
}

const DensityGrid kNoGrid{"none", vec3(0), vec3(1), uvec3(1), {0}};

}  // namespace

DensityBox::DensityBox(gpu::Device& device, const Scene& scene)
    : isThere_(scene.medium && scene.medium->grid),
      sampler_(gpu::createSampler(device)),
      program_(gpu::createComputeProgram(device, "depths of the air", shaders::render_air_box_depths_comp)) {
  const DensityGrid& grid = isThere_ ? *scene.medium->grid : kNoGrid;
  corner_ = grid.corner;
  size_ = grid.size;
  density_ = densityImage(device, grid);
  const uint32_t sources = isThere_ ? static_cast<uint32_t>(emitterRowsOf(scene).size()) + 1 : 1;
  depths_ = gpu::createImage(device, "depths of the air",
                             {.format = VK_FORMAT_R16G16B16A16_SFLOAT,
                              .width = kAirNodes,
                              .height = kAirNodes,
                              .layers = sources * kAirNodes});
}

AirBox DensityBox::of(uint32_t light) const {
  return {corner_, 1.0f / size_, float((light + 1) * kAirNodes)};
}

void DensityBox::update(const Scene& scene) {
  sources_ = {scene.camera.position};
  for (const EmitterRow& row : emitterRowsOf(scene))
    sources_.push_back(row.first.position + 0.5f * float(row.count - 1) * row.step);
}

void DensityBox::record(gpu::CommandList& commands) {
  if (!isThere_) return;
  for (std::size_t i = 0; i < sources_.size(); ++i)
    commands.dispatch(program_, uvec3(kAirNodes),
                      AirDepthConstants{sources_[i], static_cast<uint32_t>(i) * kAirNodes, corner_, size_},
                      {{"density", density_, sampler_}, {"depths", depths_}});
}

}  // namespace nephroid
