// Snell, Fresnel and Beer-Lambert, once for C++ and GLSL.
#ifndef NEPHROID_OPTICS_REFRACTION_H
#define NEPHROID_OPTICS_REFRACTION_H

#include "core/shared_language.h"

SHARED_BEGIN

// Fraction of unpolarised flux reflected at a smooth dielectric boundary. `cosIncident` >= 0 is taken against
// the normal on the incident side; `eta` is the index there over the index beyond. 1 at and past the critical
// angle.
SHARED_FUNCTION float fresnelReflectance(float cosIncident, float eta) {
  float sinTransmittedSquared = eta * eta * (1.0f - cosIncident * cosIncident);
  if (sinTransmittedSquared >= 1.0f) return 1.0f;
  float cosTransmitted = sqrt(1.0f - sinTransmittedSquared);
  float perpendicular = (eta * cosIncident - cosTransmitted) / (eta * cosIncident + cosTransmitted);
  float parallel = (cosIncident - eta * cosTransmitted) / (cosIncident + eta * cosTransmitted);
  return 0.5f * (perpendicular * perpendicular + parallel * parallel);
}

// Snell's law. `incident` is a unit vector toward the surface, `normal` unit on the incident side. False past
// the critical angle, where nothing is transmitted and `transmitted` is left as `incident`.
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

// What a length (m) of the material leaves, when `attenuationColor` is left after `attenuationDistance` (m);
// an infinite or zero distance means a clear material. (KHR_materials_volume)
SHARED_FUNCTION vec3 volumeTransmittance(vec3 attenuationColor, float inverseAttenuationDistance,
                                         float pathLength) {
  if (inverseAttenuationDistance <= 0.0f) return vec3(1.0f);
  return pow(attenuationColor, vec3(pathLength * inverseAttenuationDistance));
}

SHARED_END

#endif
