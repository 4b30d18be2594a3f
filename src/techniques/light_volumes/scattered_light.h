// Light that water scatters along its beams (god rays). It is sampled on layers across the beams, as Dobashi
// 2002 samples shafts on planes.
#pragma once

#include <vector>

#include "beams/light_layers.h"
#include "gpu/program.h"
#include "gpu/resources.h"
#include "techniques/light_volumes/scatter_data.h"
#include "techniques/technique.h"

namespace nephroid {

// For each frame: call begin, add for each portion of the light, upload, then draw for each object that
// scatters.
class ScatteredLight {
 public:
  // The device must outlive it.
  explicit ScatteredLight(gpu::Device& device);

  void begin() { count_ = 0; }

  // Adds light inside an object whose material scatters. The light goes about along `axis` (unit).
  void add(const Scene& scene, uint32_t object, std::span<const Beam> beams, vec3 axis);

  std::size_t count() const { return count_; }
  void upload(gpu::CommandList& commands) const;
  void draw(gpu::CommandList& commands, const WaysOfSight& ways, const gpu::Image& luminance) const;

 private:
  struct Portion {
    uint32_t object = 0;
    ScatterConstants constants{};
    gpu::Image layers;  // as LightLayers has them, over a common scale
    gpu::Buffer staged;
  };
  void write(Portion& portion, const LightLayers& light, float scale);

  gpu::Device& device_;
  gpu::Program program_;
  gpu::Sampler sampler_;
  std::vector<Portion> portions_;
  std::size_t count_ = 0;  // of the portions, in the frame being made
};

}  // namespace nephroid
