// How air scatters light, once for C++ and GLSL. Each phase function integrates to one over all directions.
#ifndef NEPHROID_OPTICS_PHASE_H
#define NEPHROID_OPTICS_PHASE_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kPhaseIsotropic = 0u;
SHARED_CONSTANT uint kPhaseHenyeyGreenstein = 1u;
SHARED_CONSTANT uint kPhaseNishita = 2u;

// 1/sr scattered from one direction of travel into another; `cosine` is that of the angle between them, 1 for
// light that goes straight on. `g`: mean cosine (Henyey and Greenstein 1941). Nishita: K (1 + 9 cos^16(angle
// / 2)) (Dobashi 2002, after Nishita 1987), of which K is 1 / (8 pi).
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
