// Shows the output images of passes as pictures.
#pragma once

#include "gpu/program.h"
#include "techniques/pass_output.h"

namespace nephroid {

class OutputView {
 public:
  // The device outlives it.
  explicit OutputView(gpu::Device& device);

  // Makes a picture (rgba8, `size` pixels) of all layers of the image, side by side. It is valid until the
  // next call.
  const gpu::Image& show(const PassOutput& output, uvec2 size);

 private:
  gpu::Device& device_;
  gpu::Program plain_, layers_, words_;
  gpu::Image picture_;
};

}  // namespace nephroid
