// The sea's surface as a sum of waves over a spectrum, by the fast Fourier transform (Tessendorf 2001,
// "Simulating Ocean Water"; JONSWAP: Hasselmann et al. 1973).
#pragma once

#include <vector>

#include "water/water.h"

namespace nephroid {

// m^4 per radian^2: the variance of height over the plane of wave vectors (rad/m).
double spectralDensity(const OceanSpectrum& ocean, glm::dvec2 waveVector);

// The angular frequency (rad/s) of gravity waves with a wave number (rad/m) on water of a depth (m).
double waveFrequency(double waveNumber, double depth);

// The variance (m2) of the height for the waves that the water's grid can hold. 16 times the variance is the
// square of the significant height.
double oceanVariance(const Water& water);

// Values at the vertices of the water's grid, [j * grid.x + i] with i along x.
struct OceanSurface {
  std::vector<double> heights;      // m
  std::vector<glm::dvec2> slopes;   // slopes (m per m) of the height at the vertex's place before its offset
  std::vector<glm::dvec2> offsets;  // m, the displacement of vertices by choppiness, in (x, z)
};

OceanSurface oceanSurface(const Water& water, double time);

}  // namespace nephroid
