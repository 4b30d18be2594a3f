// Smooths the edges of a picture that has one sample of each pixel.
#pragma once

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"

namespace nephroid {

// Fast approximate anti-aliasing (Lottes, FXAA 3.11, quality).
class EdgeSmoothing {
 public:
  // The device outlives it. `size`: of the pictures, pixels.
  EdgeSmoothing(gpu::Device& device, uvec2 size);

  // Sets another size; the smoothed picture is black then.
  void resize(uvec2 size);

  // Makes the smoothed copy of `picture` (rgba8, sRGB). Adds the time of the pass.
  void smooth(const gpu::Image& picture, std::vector<PassTime>& passes);
  const gpu::Image& smoothed() const { return smoothed_; }

 private:
  gpu::Device& device_;
  gpu::Program marking_, smoothing_;
  gpu::Sampler sampler_;
  gpu::Image smoothed_, marks_;
};

}  // namespace nephroid
