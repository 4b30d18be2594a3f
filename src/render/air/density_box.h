// Air whose density is given cell by cell, on the device.
#pragma once

#include <vector>

#include "gpu/command_list.h"
#include "gpu/program.h"
#include "render/air/air_data.h"
#include "scene/scene.h"

namespace nephroid {

class DensityBox {
 public:
  // The device outlives it. Where the scene's air has no grid the images are there all the same, and empty.
  DensityBox(gpu::Device& device, const Scene& scene);

  bool isThere() const { return isThere_; }
  AirBox of(uint32_t light) const;

  // Takes the places of the eye and the lights.
  void update(const Scene& scene);

  // How much air lies between each of them and the nodes of the box.
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
