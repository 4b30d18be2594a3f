// The medium between objects (air, fog, clouds).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

enum class PhaseType { isotropic, henyeyGreenstein, nishita };
inline constexpr double kLargestG = 0.999;  // largest absolute value of Henyey-Greenstein's g

// The density of the air in a box, as a part (0..1) of the largest density. It is linear between the middles
// of cells, and 0 outside the box.
struct DensityGrid {
  std::string name;
  vec3 corner{0};  // m, the corner with the lowest coordinates
  vec3 size{1};    // m
  uvec3 cells{1};
  std::vector<float> densities;  // 0 to 1, [(z * cells.y + y) * cells.x + x]
};

struct Medium {
  float extinction = 0;  // 1/m
  float albedo = 0;      // scattering over extinction
  PhaseType phase = PhaseType::isotropic;
  float g = 0;        // Henyey-Greenstein
  float fogBase = 0;  // m along +y; up to this height the air has the given extinction
  float fogHeight =
      0;  // m; above fogBase the density falls by the factor e in this height; 0: it does not fall
  std::optional<DensityGrid> grid;  // multiplies the extinction
};

}  // namespace nephroid
