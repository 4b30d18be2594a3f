// Caustic light as spherical harmonics over light directions (Wyman 2004, section 4.3; Sloan et al. 2002).
// Every cell of one grid in the caster's own space has coefficients, so that a large light costs as much as a
// point. Changes of the caustic over the light's direction that are finer than the order are blurred.
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

class IrradianceVolume;

inline constexpr uint32_t kMostHarmonicOrder = 24;

// The values of the (order + 1)^2 orthonormal real spherical harmonics up to `order` for a unit vector,
// ordered by degree.
std::vector<float> sphericalHarmonics(uint32_t order, vec3 direction);

// The coefficients of the light in `base`: one layer for each harmonic, each of at most `bytes`, for the
// whole region of `radius` bounding radii.
std::vector<VolumeSample> harmonicLayers(IrradianceVolume& base, uint32_t order, float radius,
                                         std::size_t bytes);

// The words of a grid for one light. `light` holds the coefficients of the light: for a single direction its
// sphericalHarmonics, for an extended light their mean over its directions.
std::vector<uint32_t> resolveHarmonics(std::span<const std::span<const uint32_t>> layers,
                                       std::span<const float> light);

}  // namespace nephroid
