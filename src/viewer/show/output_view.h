// The images that passes leave behind, as pictures.
#pragma once

#include "gpu/program.h"
#include "techniques/pass_output.h"

namespace nephroid {

class OutputView {
 public:
  // The device outlives it.
  explicit OutputView(gpu::Device& device);

  // A picture (rgba8) of this size of all layers of the output's image, side by side. It lasts until the next
  // one.
  const gpu::Image& show(const PassOutput& output, uvec2 size);

 private:
  gpu::Device& device_;
  gpu::Program plain_, layers_, words_;
  gpu::Image picture_;
};

}  // namespace nephroid
