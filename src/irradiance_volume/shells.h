// Caustic light on concentric shells, each a subdivided octahedron, nearer to each other where the light
// changes from one to the next (Wyman 2004, section 4.2).
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

// The mean of every cell over its volume, for the region of `radius` bounding radii, in at most `bytes`.
VolumeSample shellSample(std::span<const PhotonPath> paths, float radius, std::size_t bytes);

}  // namespace nephroid
