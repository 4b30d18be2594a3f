// Shafts of light: the light that the air scatters toward the eye, and the light that it absorbs on the way
// (Dobashi 2002).
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "gpu/program.h"
#include "gpu/resources.h"
#include "render/air/air_data.h"
#include "render/air/density_box.h"
#include "render/air/settings.h"
#include "render/direct_light.h"
#include "render/view.h"

namespace nephroid {

// For each frame: call update; then, after shadow maps and depths were drawn, choosePlanes; then record.
class Shafts {
 public:
  // The device must outlive it. Without air in `scene` it does nothing.
  Shafts(gpu::Device& device, const Scene& scene, uvec2 pictureSize, const ShaftSettings& settings);

  explicit operator bool() const { return bool(image_); }

  // Sets another size (pixels) for the following pictures.
  void resize(uvec2 pictureSize);

  // The device must not be using anything of this object.
  void update(const Scene& scene, const View& view);
  // Sees the same from another place within each pixel.
  void look(const View& view);

  // The data for DirectLight::update.
  LightsInAir lightsInAir() const;

  // Computes the density of the air between the lights and points, which choosePlanes, record and
  // DirectLight::record need.
  void recordDepths(gpu::CommandList& commands) {
    if (box_) box_->record(commands);
  }

  // Chooses the number of planes for each light: draws a few rays with more and more planes, until the result
  // changes less than the error of the settings. Submits its own work to the device.
  void choosePlanes(const DirectLight& directLight, const GpuScene& gpuScene, const gpu::Image& depth);

  // `depth`: the frame's depth image of the nearest surface.
  void record(gpu::CommandList& commands, const DirectLight& directLight, const GpuScene& gpuScene,
              const gpu::Image& depth);

  // rgba32f: rgb luminance (nit), a the part of light from the nearest surface that comes to the eye.
  const gpu::Image& image() const { return image_; }

  // The planes of each light in the last frame.
  const std::vector<AirPlanes>& planes() const { return planes_; }

 private:
  using ProgramKey = DirectLight::ProgramKey;
  void draw(gpu::CommandList& commands, const DirectLight& directLight, const GpuScene& gpuScene,
            const gpu::Image& depth, uint32_t light, uint64_t address);
  const gpu::Program& program(const ProgramKey& key);
  std::vector<vec4> glimpse(const DirectLight& directLight, const GpuScene& gpuScene, const gpu::Image& depth,
                            uint32_t light, const AirPlanes& planes);
  AirPlanes chosenPlanes(const DirectLight& directLight, const GpuScene& gpuScene, const gpu::Image& depth,
                         uint32_t light);
  void write(uint32_t index, uint32_t light, const AirPlanes& planes, uint32_t stride) const;

  gpu::Device& device_;
  ShaftSettings settings_;
  uint32_t phase_ = 0;
  gpu::Program transmittance_;
  std::map<ProgramKey, gpu::Program> programs_;
  std::optional<DensityBox> box_;
  gpu::Sampler sampler_;
  gpu::Image image_, glimpse_;
  gpu::Buffer lights_;  // AirLight of each light, and one for glimpses last

  // Of the frame being made.
  uint32_t lightCount_ = 0;
  Air air_{};
  AirSight sight_{};
  std::vector<AirPlanes> planes_;
};

}  // namespace nephroid
