#include "reference/direct.h"

namespace nephroid {

bool isLit(const RayScene& rays, const Illumination& illumination, vec3 point, float clearance) {
  return !rays.occluded({point, -illumination.direction, clearance, beforeLamp(illumination.distance)});
}

vec3 directIlluminance(const Boundaries& boundaries, const Lights& lights, uint32_t light,
                       const LitPoint& point, float u) {
  const Illumination illumination = lights.illumination(light, point.position, u);
  const float cosine = -dot(illumination.direction, point.normal);
  const float cosineToSurface = -dot(illumination.direction, point.geometricNormal);
  if (cosine <= 0 || cosineToSurface <= 0) return vec3(0);
  if (illumination.illuminance == vec3(0)) return vec3(0);
  const float clearance = point.rounding / std::max(cosineToSurface, 0.01f);
  if (!isLit(boundaries.rayScene(), illumination, point.position, clearance)) return vec3(0);
  vec3 lux = cosine * illumination.illuminance;
  if (!lights.comesFromAfar(light))
    lux *= boundaries.transmittance(point.medium, point.position, -illumination.direction,
                                    illumination.distance);
  return lux;
}

}  // namespace nephroid
