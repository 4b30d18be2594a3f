// A picture of the levels of landed light: which cell each receiver's point reads.
#pragma once

#include "gpu/program.h"
#include "techniques/adaptive_beams/landed_light.h"
#include "techniques/technique.h"

namespace nephroid {

// How many of the cells that are read there are at each level.
std::vector<uint64_t> cellsAtLevels(const LandedLight& light);

class LevelPicture {
 public:
  // The device outlives it. Takes nothing on it until a picture is made.
  explicit LevelPicture(gpu::Device& device) : device_(device) {}

  // Makes the picture (rgba8, of the size of the points' images) in a submission of its own, and the legend:
  // the texels of each level, in mm. The picture is valid until the next call. `cells`: those of `light`.
  const gpu::Image* draw(const LandedLight& light, const gpu::Image& cells, const gpu::Sampler& sampler,
                         const ReceiverPoints& points, Legend& legend);

 private:
  gpu::Device& device_;
  gpu::Program program_;
  gpu::Image picture_;
};

}  // namespace nephroid
