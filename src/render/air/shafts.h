// Shafts of light: what the air between the objects scatters of the lights toward the eye, and what it takes
// away (Dobashi 2002).
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

// One frame is update, then, when shadow maps and depths are drawn, choosePlanes, then record.
class Shafts {
 public:
  // The device outlives it. The air is that of `scene`; where there is none nothing is done.
  Shafts(gpu::Device& device, const Scene& scene, uvec2 pictureSize, const ShaftSettings& settings);

  explicit operator bool() const { return bool(image_); }

  // Pictures are of another size from now on.
  void resize(uvec2 pictureSize);

  // Nothing is in use by the device.
  void update(const Scene& scene, const View& view);

  // What DirectLight::update asks for.
  LightsInAir lightsInAir() const;

  // What choosePlanes, record and DirectLight::record look up: how much air there is on the way from the
  // lights.
  void recordDepths(gpu::CommandList& commands) {
    if (box_) box_->record(commands);
  }

  // Sees each light by a few rays with more and more planes, until they change no more than is asked for.
  // Submits work of its own.
  void choosePlanes(const DirectLight& directLight, const GpuScene& gpuScene, const gpu::Image& depth);

  // `depth` is the frame's: of the nearest surface.
  void record(gpu::CommandList& commands, const DirectLight& directLight, const GpuScene& gpuScene,
              const gpu::Image& depth);

  // rgba32f: rgb luminance (nit), a the part of light from the nearest surface that comes to the eye.
  const gpu::Image& image() const { return image_; }

  // Of the last frame, of each light.
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
