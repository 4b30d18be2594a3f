// The medium inside a dielectric object, computed with the functions of optics/.
#pragma once

#include "optics/phase.h"
#include "optics/refraction.h"
#include "scene/scene.h"

namespace nephroid {

// The shaders' constant (kPhase...) of a phase function.
inline uint phaseCode(PhaseType type) {
  switch (type) {
    case PhaseType::henyeyGreenstein:
      return kPhaseHenyeyGreenstein;
    case PhaseType::nishita:
      return kPhaseNishita;
    default:
      return kPhaseIsotropic;
  }
}

inline bool hasVolume(const Material& material) {
  return material.type == MaterialType::dielectric && !material.thinWalled;
}

inline bool scatters(const Material& material) {
  return hasVolume(material) && material.scattering != vec3(0);
}

// Extinction (1/m): absorption and scattering.
inline vec3 extinctionOf(const Material& material) {
  if (!hasVolume(material)) return vec3(0);
  return material.scattering -
         glm::log(glm::max(material.attenuationColor, vec3(1e-30f))) * material.inverseAttenuationDistance();
}

// The transmittance (0..1 per channel) of a length (m) of it.
inline vec3 transmittanceOf(const Material& material, float length) {
  const vec3 left =
      volumeTransmittance(material.attenuationColor, material.inverseAttenuationDistance(), length);
  return material.scattering == vec3(0) ? left : left * glm::exp(-material.scattering * length);
}

}  // namespace nephroid
