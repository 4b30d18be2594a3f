#include "reference/direct.h"

namespace nephroid {

bool isLit(const RayScene& rays, const Illumination& illumination, vec3 point, float clearance) {
  const float margin = rays.selfIntersectionDistance();
  return !rays.occluded({point, -illumination.direction, clearance, illumination.distance - margin});
}

vec3 directIlluminance(const Boundaries& boundaries, const Lights& lights, uint32_t light,
                       const LitPoint& point, Random& random) {
  const Illumination illumination = lights.illumination(light, point.position, random.uniform());
  const float cosine = -dot(illumination.direction, point.normal);
  if (cosine <= 0 || dot(illumination.direction, point.geometricNormal) >= 0) return vec3(0);
  if (illumination.illuminance == vec3(0)) return vec3(0);
  if (!isLit(boundaries.rayScene(), illumination, point.position, point.clearance)) return vec3(0);
  vec3 lux = cosine * illumination.illuminance;
  if (!lights.comesFromAfar(light))
    lux *= boundaries.transmittance(point.medium, point.position, -illumination.direction,
                                    illumination.distance);
  return lux;
}

}  // namespace nephroid
