// The medium between the objects.
#pragma once

#include "optics/phase.h"
#include "scene/scene.h"

namespace nephroid {

// 1/m
inline float scatteringCoefficient(const Medium& medium) {
  return medium.extinction * medium.albedo;
}

// 1/sr; `cosine` between the ways light travels before and after.
inline float phaseOf(const Medium& medium, float cosine) {
  switch (medium.phase) {
    case PhaseType::isotropic:
      return phaseFunction(kPhaseIsotropic, medium.g, cosine);
    case PhaseType::henyeyGreenstein:
      return phaseFunction(kPhaseHenyeyGreenstein, medium.g, cosine);
    case PhaseType::nishita:
      return phaseFunction(kPhaseNishita, medium.g, cosine);
  }
  return 0;
}

}  // namespace nephroid
