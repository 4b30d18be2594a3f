// What the air takes of a light.
#pragma once

#include <cmath>

#include "lights/emitter.h"
#include "scene/air.h"
#include "scene/scene.h"

namespace nephroid {

// The part of an emitter's light that the air lets come to `point`. Light from afar is as strong as it is
// said to be until it meets something.
inline float airTransmittance(const Scene& scene, const Emitter& emitter, vec3 point) {
  if (!scene.medium || emitter.type == kEmitterDirectional) return 1;
  const vec3 offset = point - emitter.position;
  const float way = length(offset);
  return way > 0 ? std::exp(-opticalDepth(*scene.medium, emitter.position, offset / way, way)) : 1.0f;
}

}  // namespace nephroid
