// Caustic light on a grid with several resolutions. The grid is cut into bricks; each is as coarse as an
// error bound allows (the multi-resolution volumes of Wyman 2004, section 4.3, with look-ups in constant
// time).
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

// `finestBytes`: the size of the finest grid. In each brick, the root mean square difference from that grid
// is at most `bound` (lux, for light of 1 lux).
VolumeSample brickSample(std::span<const PhotonPath> paths, std::size_t finestBytes, float bound);

}  // namespace nephroid
