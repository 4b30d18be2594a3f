// Landed beams widened by the size of their lamp.
#pragma once

#include <cstddef>
#include <span>

#include "beams/ray_mesh/ray_mesh.h"
#include "lights/lamp_cells.h"

namespace nephroid {

// m that a beam's corners land off for another place on the lamp, one standard deviation off along each of
// its axes.
struct BeamShift {
  vec3 corner[3][2];
};

// Into how many beams one has to be parted for a lamp's image of standard deviation `blur` (m), where the
// light is seen in a detail of so many m.
std::size_t copiesFor(float blur, float detail);

// Parts `beam` into `beams`, one for each of as many points of the lamp, each smeared by what its point
// stands for. `normal`: unit, of the receiver.
void widen(const LandedBeam& beam, const BeamShift& shift, const LampSpread& lamp, vec3 normal,
           std::span<LandedBeam> beams);

}  // namespace nephroid
