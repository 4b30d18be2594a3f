// Caustic light on a uniform grid (Wyman 2004, section 4.2), which is turned along the light and just holds
// it.
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

// A box in a sample's frame, in bounding radii.
struct LitBox {
  vec3 low{0};
  vec3 high{0};
};

// The box that holds 99.9 % of the paths' light. Empty where there is no light.
LitBox litBox(std::span<const PhotonPath> paths);

// A grid of at most `cells` cubic cells around the box.
SampleLayout gridAround(const LitBox& box, std::size_t cells);

// The mean light of each cell over its volume, [(z * size.y + y) * size.x + x].
std::vector<CellSum> gridSums(std::span<const PhotonPath> paths, const SampleLayout& layout);

// A grid of the mean light of each cell, in at most `bytes`. The flux is exact, because a path adds to each
// cell in proportion to its length in the cell.
VolumeSample gridSample(std::span<const PhotonPath> paths, std::size_t bytes);

}  // namespace nephroid
