// Air whose density is given cell by cell.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// Part of the densest, 0 to 1; 0 outside the grid.
float densityAt(const DensityGrid& grid, vec3 point);

// Integral of densityAt (m) along a straight way, by two steps a cell.
float densityAlong(const DensityGrid& grid, vec3 from, vec3 direction, float length);

// Clouds: value noise in octaves, each half as coarse and half as strong as the one before.
struct NoiseSettings {
  float feature = 1;  // m, the coarsest octave
  uint32_t octaves = 4;
  uint32_t seed = 1;
  float clear = 0.3f;  // noise up to here, of 0 to 1, is clear air
};
void fillWithNoise(DensityGrid& grid, const NoiseSettings& settings);

}  // namespace nephroid
