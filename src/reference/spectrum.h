// Colour and wavelength: what a band of the spectrum is in linear Rec. 709, and how it is refracted.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "scene/scene.h"

namespace nephroid {

// How light is split where a material disperses it. channels: red, green and blue, each with its own index,
// as the techniques have it. continuous: wavelengths.
enum class Spectrum { channels, continuous };

// A part of white light. Of the bands of one set each is as likely as the others, and the mean of their
// weights is white.
struct Band {
  float wavelength = 0;  // nm; 0 for a channel
  uint32_t channel = 1;
  vec3 weight{1};  // linear Rec. 709, to multiply light that was dispersed with
};

// Wavelengths that are looked at.
inline constexpr float kShortestWavelength = 380;  // nm
inline constexpr float kLongestWavelength = 730;   // nm

// Density (1/nm) with which bands are chosen, and the weight of a band at a wavelength (nm). Colour matching
// after Wyman, Sloan and Shirley 2013, in Rec. 709 with what lies outside it cut off, so that no light is
// negative; equal energy is white.
float wavelengthDensity(float wavelength);
vec3 wavelengthWeight(float wavelength);

// A wavelength (nm) with that density, by inversion; `u` in [0, 1).
float sampleWavelength(float u);

// The bands that a pass is traced in: the three channels, or wavelengths, one from each part of equal
// probability; one white band where the scene disperses nothing.
std::vector<Band> chooseBands(const Scene& scene, Spectrum spectrum, Random& random);

// The index of refraction of a dielectric in a band. Where a material has an Abbe number: Cauchy's formula
// through its d line; else the three indices stand at 611, 549 and 464 nm, the dominant wavelengths of Rec.
// 709's primaries, and the index is linear in 1 / wavelength^2 between and beyond them.
float indexOfRefraction(const Material& material, const Band& band);

}  // namespace nephroid
