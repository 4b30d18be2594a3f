// Caustic light as spherical harmonics over light directions (Wyman 2004, section 4.3; Sloan et al. 2002):
// every cell of one grid in the caster's own space has coefficients, so that a light of any extent costs what
// a point does. Blurs what changes faster with the light than its order can.
#pragma once

#include "irradiance_volume/sample.h"

namespace nephroid {

class IrradianceVolume;

inline constexpr uint32_t kMostHarmonicOrder = 24;

// Orthonormal real spherical harmonics of a unit vector up to `order`, (order + 1)^2 of them, by degree.
std::vector<float> sphericalHarmonics(uint32_t order, vec3 direction);

// The coefficients of what `base` holds, a layer each, of at most `bytes`, for its whole region of `radius`
// bounding radii.
std::vector<VolumeSample> harmonicLayers(IrradianceVolume& base, uint32_t order, float radius,
                                         std::size_t bytes);

// The words of a grid for light whose own coefficients are `light`: one direction's are its
// sphericalHarmonics, those of an extended one the mean of them.
std::vector<uint32_t> resolveHarmonics(std::span<const std::span<const uint32_t>> layers,
                                       std::span<const float> light);

}  // namespace nephroid
