// Settings for how finely the light of casters is divided into beams.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct BeamDivision {
  uint32_t refineDepth = 2;  // how many times a triangle may be cut into four
  float shadowTolerance =
      0.65f;  // 0..1, the part of a cell of water that may be in shadow while the cell passes light
  bool operator==(const BeamDivision&) const = default;
};

std::span<const Setting> beamSettings();

}  // namespace nephroid
