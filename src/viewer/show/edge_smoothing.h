// Smooths the edges of a picture that has one sample of each pixel.
#pragma once

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "gpu/resources.h"

namespace nephroid {

// Fast approximate anti-aliasing (Lottes, FXAA 3.11, quality).
class EdgeSmoothing {
 public:
  // The device outlives it.
  explicit EdgeSmoothing(gpu::Device& device);

  // Makes a smoothed copy of `picture` (rgba8, sRGB). It is valid until the next call. Adds the time of the
  // pass.
  const gpu::Image& smooth(const gpu::Image& picture, std::vector<PassTime>& passes);

 private:
  gpu::Device& device_;
  gpu::Program marking_, smoothing_;
  gpu::Sampler sampler_;
  gpu::Image smoothed_, marks_;
};

}  // namespace nephroid
