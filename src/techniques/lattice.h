// A grid in the scene on which something is computed; the viewer draws it over the picture.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

enum class LatticeKind { planes, slices, cells };

// A parallelepiped cut into cells along its edges; flat where the third edge is 0. World space, m.
struct Lattice {
  LatticeKind kind = LatticeKind::planes;
  vec3 corner{0};
  std::array<vec3, 3> edges{};
  uvec3 cells{1};
};

}  // namespace nephroid
