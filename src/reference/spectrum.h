// Bands of the spectrum: their color in linear Rec. 709, and their index of refraction.
#pragma once

#include <cstdint>
#include <vector>

#include "core/random.h"
#include "scene/scene.h"

namespace nephroid {

// How dispersed light is divided. channels: red, green and blue, each with its own index of refraction, as in
// the techniques. continuous: wavelengths.
enum class Spectrum { channels, continuous };

// A part of white light. All bands of a set are equally likely, and the mean of their weights is white.
struct Band {
  float wavelength = 0;  // nm; 0 for a channel
  uint32_t channel = 1;
  vec3 weight{1};  // linear Rec. 709; multiplies light that was dispersed
};

// The range of wavelengths.
inline constexpr float kShortestWavelength = 380;  // nm
inline constexpr float kLongestWavelength = 730;   // nm

// The density (1/nm) with which wavelengths (nm) are chosen, and the weight of a band at a wavelength. The
// color matching functions are those of Wyman, Sloan and Shirley 2013, in Rec. 709. Colors outside Rec. 709
// are cut off, so that no light is negative. A spectrum of equal energy is white.
float wavelengthDensity(float wavelength);
vec3 wavelengthWeight(float wavelength);

// Chooses a wavelength (nm) with that density. `u` in [0, 1).
float sampleWavelength(float u);

// The bands of a pass: the three channels, or several wavelengths, one from each part of equal probability.
// Only one white band where nothing in the scene disperses light.
std::vector<Band> chooseBands(const Scene& scene, Spectrum spectrum, Random& random);

// The index of refraction of a dielectric in a band. For a material with an Abbe number it follows Cauchy's
// formula. Otherwise the three indices belong to 611, 549 and 464 nm, the dominant wavelengths of Rec. 709's
// primaries, and the index is linear in 1 / wavelength^2 between and beyond them.
float indexOfRefraction(const Material& material, const Band& band);

}  // namespace nephroid
