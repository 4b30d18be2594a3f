// Landed beams widened by the size of their lamp.
#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "beams/ray_mesh/ray_mesh.h"
#include "lights/lamp_cells.h"

namespace nephroid {

// m that a beam's corners land off for another place on the lamp, one standard deviation off along each of
// its axes.
struct BeamShift {
  vec3 corner[3][2];
  // And of the ways that lead there: where they begin (m), and their directions (unit).
  vec3 start[3], startShift[3][2], direction[3], directionShift[3][2];
};

// Into how many beams one is parted, and whether those next to it use other points of the lamp: large ones
// share their sides with others, and must not part from them.
struct BeamCopies {
  std::size_t count = 1;
  bool areMixed = false;
};

// Of a beam that is `longest` (m), for a lamp's image of standard deviation `blur` (m), where the light is
// seen in a detail of so many m. `isOneOfMore`: other parts of the lamp have beams there as well.
BeamCopies copiesFor(float blur, float detail, float longest, bool isOneOfMore);

// Parts `beam` into `beams`, one for each of as many points of the lamp, each smeared by what its point
// stands for. `normal`: unit, of the receiver. `number`: of a beam that is mixed with others.
void widen(const LandedBeam& beam, const BeamShift& shift, const LampSpread& lamp, vec3 normal,
           std::optional<std::size_t> number, std::span<LandedBeam> beams);

}  // namespace nephroid
