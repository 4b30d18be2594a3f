// The air, and how a volume scatters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

enum class PhaseType { isotropic, henyeyGreenstein, nishita };
inline constexpr double kLargestG = 0.999;  // of Henyey-Greenstein, forward or back

// How dense the air is in a box, as a part of the most there may be: linear between the middles of its cells,
// and 0 outside.
struct DensityGrid {
  std::string name;
  vec3 corner{0};  // m, where all coordinates are lowest
  vec3 size{1};    // m
  uvec3 cells{1};
  std::vector<float> densities;  // 0 to 1, [(z * cells.y + y) * cells.x + x]
};

struct Medium {
  float extinction = 0;  // 1/m
  float albedo = 0;      // scattering over extinction
  PhaseType phase = PhaseType::isotropic;
  float g = 0;                      // Henyey-Greenstein
  float fogBase = 0;                // m along +y, up to where the air is as dense as `extinction` says
  float fogHeight = 0;              // m, above there, in which it thins out by the factor e; 0: it never does
  std::optional<DensityGrid> grid;  // multiplies that
};

}  // namespace nephroid
