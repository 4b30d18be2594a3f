// The laws of Snell, Fresnel and Beer-Lambert. Written once for C++ and GLSL.
#ifndef NEPHROID_OPTICS_REFRACTION_H
#define NEPHROID_OPTICS_REFRACTION_H

#include "core/shared_language.h"

SHARED_BEGIN

// The part (0..1) of unpolarized flux that is reflected at a smooth dielectric boundary. `cosIncident` >= 0:
// cosine of the angle to the normal. `eta`: the index of refraction on the incident side divided by the one
// on the other side. The result is 1 at the critical angle and beyond.
SHARED_FUNCTION float fresnelReflectance(float cosIncident, float eta) {
  float sinTransmittedSquared = eta * eta * (1.0f - cosIncident * cosIncident);
  if (sinTransmittedSquared >= 1.0f) return 1.0f;
  float cosTransmitted = sqrt(1.0f - sinTransmittedSquared);
  float perpendicular = (eta * cosIncident - cosTransmitted) / (eta * cosIncident + cosTransmitted);
  float parallel = (cosIncident - eta * cosTransmitted) / (cosIncident + eta * cosTransmitted);
  return 0.5f * (perpendicular * perpendicular + parallel * parallel);
}

// Snell's law. `incident`: unit, toward the surface. `normal`: unit, on the incident side. `eta`: as above.
// Returns false beyond the critical angle; nothing is transmitted there, and `transmitted` is `incident`.
SHARED_FUNCTION bool refractDirection(vec3 incident, vec3 normal, float eta, OUT(vec3) transmitted) {
  float cosIncident = -dot(incident, normal);
  float sinTransmittedSquared = eta * eta * (1.0f - cosIncident * cosIncident);
  transmitted = incident;
  if (sinTransmittedSquared >= 1.0f) return false;
  float cosTransmitted = sqrt(1.0f - sinTransmittedSquared);
  transmitted = normalize(eta * incident + (eta * cosIncident - cosTransmitted) * normal);
  return true;
}

SHARED_FUNCTION vec3 reflectDirection(vec3 incident, vec3 normal) {
  return incident - 2.0f * dot(incident, normal) * normal;
}

// The transmittance (0..1 per channel) of `pathLength` (m) of a material with the transmittance
// `attenuationColor` after 1 / `inverseAttenuationDistance` (m) (KHR_materials_volume). An inverse distance
// of 0 means a clear material.
SHARED_FUNCTION vec3 volumeTransmittance(vec3 attenuationColor, float inverseAttenuationDistance,
                                         float pathLength) {
  if (inverseAttenuationDistance <= 0.0f) return vec3(1.0f);
  return pow(attenuationColor, vec3(pathLength * inverseAttenuationDistance));
}

SHARED_END

#endif
