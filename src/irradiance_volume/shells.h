// Caustic light on concentric shells. Each shell is a subdivided octahedron; shells are denser where the
// light changes faster along the radius (Wyman 2004, section 4.2).
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

// Shells with the mean light of each cell, for the region of `radius` bounding radii, in at most `bytes`.
VolumeSample shellSample(std::span<const PhotonPath> paths, float radius, std::size_t bytes);

}  // namespace nephroid
