// How finely the light of casters is divided into beams.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct BeamDivision {
  uint32_t refineDepth = 2;       // times a beam may be halved along its edges
  float shadowTolerance = 0.65f;  // the part of a cell of water that may be in shadow and still pass light
  bool operator==(const BeamDivision&) const = default;
};

std::span<const Setting> beamSettings();

}  // namespace nephroid
