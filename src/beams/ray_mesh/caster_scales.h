// How large casters are, and how much of their light counts, where receivers' points see it.
#pragma once

#include <span>
#include <vector>

#include "beams/ray_mesh/caster_light.h"
#include "beams/ray_mesh/ray_mesh.h"

namespace nephroid {

class CasterScales {
 public:
  // `settings` must outlive it.
  CasterScales(const Scene& scene, const RayMeshSettings& settings);

  // m, side of a receiver's point at a place where a caster's light lands.
  float pointAt(vec3 position, uint32_t caster) const;

  // lm, for each of the lights: what its sheets have to be compared with, to know whether they carry much. It
  // is the light onto its caster, so that a ball beside a pool is followed as if it were alone; and more
  // where there are many casters. `fluxes`: lm onto the casters, of the lights.
  std::vector<float> fullFluxes(std::span<const CasterLight> lights, std::span<const double> fluxes) const;

 private:
  struct Extent {
    vec3 center{0};  // m
    float size = 0;  // m, along the diagonal
  };
  const RayMeshSettings& settings_;
  std::vector<Extent> extents_;  // of the objects that are casters
};

}  // namespace nephroid
