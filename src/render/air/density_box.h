// Air whose density is given in cells, on the device.
#pragma once

#include <vector>

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "render/air/air_data.h"
#include "scene/scene.h"

namespace nephroid {

class DensityBox {
 public:
  // The device must outlive it. Where the scene's air has no grid, the images exist too, but are empty.
  DensityBox(gpu::Device& device, const Scene& scene);

  bool isThere() const { return isThere_; }
  AirBox of(uint32_t light) const;

  // Takes the positions of the eye and the lights.
  void update(const Scene& scene);

  // Computes the density between the eye or a light and each node of the box.
  void record(gpu::CommandList& commands);

  const gpu::Image& density() const { return density_; }
  const gpu::Image& depths() const { return depths_; }  // those of the eye first, then of each light

 private:
  bool isThere_ = false;
  vec3 corner_{0}, size_{1};  // m
  gpu::Image density_, depths_;
  gpu::Sampler sampler_;
  gpu::Program program_;
  std::vector<vec3> sources_;  // m
};

}  // namespace nephroid
