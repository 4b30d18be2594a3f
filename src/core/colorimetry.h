// Colors of spectra.
#pragma once

#include <cmath>

#include "core/shared_language.h"

namespace nephroid {

inline constexpr float kMostLumensPerWatt = 683;  // at 555 nm

// CIE 1931 2 degree observer at a wavelength (nm), multi-lobe fit (Wyman, Sloan and Shirley 2013, table 1).
inline vec3 colorMatching(float wavelength) {
  const auto lobe = [&](float middle, float below, float above) {
    const float t = (wavelength - middle) * (wavelength < middle ? below : above);
    return std::exp(-0.5f * t * t);
  };
  return {0.362f * lobe(442.0f, 0.0624f, 0.0374f) + 1.056f * lobe(599.8f, 0.0264f, 0.0323f) -
              0.065f * lobe(501.1f, 0.0490f, 0.0382f),
          0.821f * lobe(568.8f, 0.0213f, 0.0247f) + 0.286f * lobe(530.9f, 0.0613f, 0.0322f),
          1.217f * lobe(437.0f, 0.0845f, 0.0278f) + 0.681f * lobe(459.0f, 0.0385f, 0.0725f)};
}

// Linear Rec. 709 from CIE XYZ (ITU-R BT.709, D65).
inline vec3 rec709FromXyz(vec3 xyz) {
  return {dot(vec3(3.2404542f, -1.5371385f, -0.4985314f), xyz),
          dot(vec3(-0.9692660f, 1.8760108f, 0.0415560f), xyz),
          dot(vec3(0.0556434f, -0.2040259f, 1.0572252f), xyz)};
}

}  // namespace nephroid
