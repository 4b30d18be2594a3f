// Caustic light on a uniform grid (Wyman 2004, section 4.2), turned along the light and fitted around where
// it goes.
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

// A box in a sample's frame.
struct LitBox {
  vec3 low{0};
  vec3 high{0};
};

// What holds all of the paths' light but 0.1 %. Empty where there is none.
LitBox litBox(std::span<const PhotonPath> paths);

// Cubic cells around the box, at most `cells` of them.
SampleLayout gridAround(const LitBox& box, std::size_t cells);

// The mean of every cell over its volume, by x, then y, then z.
std::vector<CellSum> gridSums(std::span<const PhotonPath> paths, const SampleLayout& layout);

// The mean of every cell over its volume, in at most `bytes`. Exact in flux: a path leaves in a cell what it
// does on its way through.
VolumeSample gridSample(std::span<const PhotonPath> paths, std::size_t bytes);

}  // namespace nephroid
