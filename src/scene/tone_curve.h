// How luminance becomes the values of a screen. The curves are in render/tone_mapping.h.
#pragma once

#include <array>
#include <cmath>

namespace nephroid {

enum class ToneCurve : unsigned { neutral, agx, aces, linear };

inline constexpr std::array<const char*, 4> kToneCurveNames{"neutral", "agx", "aces", "linear"};
constexpr const auto& namesOf(ToneCurve) {
  return kToneCurveNames;
}

// What scenes and users write for an exposure that is metered; and limits of the others.
inline constexpr const char* kAutoExposure = "auto";
inline constexpr double kLeastExposure = 1e-12, kMostExposure = 1e12;
inline constexpr double kMostEv100 = 39;  // and the least is -39

// What multiplies luminance (nit) at an exposure value at ISO 100, so that 1.2 * 2^ev100 nit become 1: a
// camera whose lens lets q = 0.65 of the light through saturates there (ISO 12232; Lagarde and de Rousiers,
// "Moving Frostbite to physically based rendering", 2014, section 5.1).
inline double exposureOfEv100(double ev100) {
  return 1 / (1.2 * std::exp2(ev100));
}
inline double ev100OfExposure(double exposure) {
  return -std::log2(1.2 * exposure);
}

}  // namespace nephroid
