// What is large and what is small for the light of a caster: the detail that is seen where it lands, and the
// light that a part of it is compared with.
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
  const RayMeshSettings& settings_;
  std::vector<float> sizes_;  // m, of the objects: along the diagonal of a caster, 0 of others
};

}  // namespace nephroid
