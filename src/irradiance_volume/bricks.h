// Caustic light at as many resolutions as it needs: a grid cut into bricks, each as fine as keeps it within a
// bound of the finest (the multi-resolution volumes of Wyman 2004, section 4.3, with look-ups in constant
// time).
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

// From a grid of `finestBytes`. Within each brick the root of the mean square difference to that grid is at
// most `bound`, lux for light of 1 lux.
VolumeSample brickSample(std::span<const PhotonPath> paths, std::size_t finestBytes, float bound);

}  // namespace nephroid
