// Air whose density is given in the cells of a grid.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// The density at a point as a part of the highest density, 0 to 1; 0 outside the grid.
float densityAt(const DensityGrid& grid, vec3 point);

// The integral (m) of densityAt along `direction` (unit) over `length` (m), with two steps for each cell.
float densityAlong(const DensityGrid& grid, vec3 from, vec3 direction, float length);

// Settings of clouds: value noise in octaves, each half as coarse and half as strong as the one before.
struct NoiseSettings {
  float feature = 1;  // m, the coarsest octave
  uint32_t octaves = 4;
  uint32_t seed = 1;
  float clear = 0.3f;  // noise (0..1) up to this value becomes clear air
};
void fillWithNoise(DensityGrid& grid, const NoiseSettings& settings);

}  // namespace nephroid
