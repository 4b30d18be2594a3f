// The sea's surface as a sum of waves over a spectrum, by the fast Fourier transform (Tessendorf 2001,
// "Simulating Ocean Water"; JONSWAP: Hasselmann et al. 1973).
#pragma once

#include <vector>

#include "water/water.h"

namespace nephroid {

// m^4 per radian^2: the variance of height over the plane of wave vectors (rad/m).
double spectralDensity(const OceanSpectrum& ocean, glm::dvec2 waveVector);

// rad/s, of gravity waves of that wave number (rad/m) on water of a depth (m).
double waveFrequency(double waveNumber, double depth);

// m2, that waves of the water's grid have between them: 16 of it are the significant height squared.
double oceanVariance(const Water& water);

// At the vertices of the water's grid, x fastest.
struct OceanSurface {
  std::vector<double> heights;      // m
  std::vector<glm::dvec2> slopes;   // of the height over where a vertex started from
  std::vector<glm::dvec2> offsets;  // m that choppiness moves vertices, in (x, z)
};

OceanSurface oceanSurface(const Water& water, double time);

}  // namespace nephroid
