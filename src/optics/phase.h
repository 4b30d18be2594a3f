// The phase functions, with which air and water scatter light. Each integrates to 1 over all directions.
// Written once for C++ and GLSL.
#ifndef NEPHROID_OPTICS_PHASE_H
#define NEPHROID_OPTICS_PHASE_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kPhaseIsotropic = 0u;
SHARED_CONSTANT uint kPhaseHenyeyGreenstein = 1u;
SHARED_CONSTANT uint kPhaseNishita = 2u;

// The part of the scattered light per solid angle (1/sr) that goes from one direction of travel into another.
// `cosine` is the cosine of the angle between the two: 1 for light that goes straight on. `g` is the mean
// cosine (Henyey and Greenstein 1941). Nishita: K (1 + 9 cos^16(angle / 2)) with K = 1 / (8 pi) (Dobashi
// 2002, after Nishita 1987).
SHARED_FUNCTION float phaseFunction(uint type, float g, float cosine) {
  const float inverseFourPi = 0.0795774715f;
  if (type == kPhaseHenyeyGreenstein) {
    float base = 1.0f + g * g - 2.0f * g * cosine;
    return inverseFourPi * (1.0f - g * g) / (base * sqrt(base));
  }
  if (type == kPhaseNishita) {
    float forward = 0.5f * (1.0f + cosine);  // the square of the half angle's cosine
    float squared = forward * forward;
    float fourth = squared * squared;
    return 0.5f * inverseFourPi * (1.0f + 9.0f * fourth * fourth);
  }
  return inverseFourPi;
}

SHARED_END

#endif
