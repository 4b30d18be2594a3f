// The loss of light in the air.
#pragma once

#include <cmath>

#include "lights/emitter.h"
#include "scene/air.h"
#include "scene/scene.h"

namespace nephroid {

// The part (0..1) of an emitter's light that comes through the air to `point`. 1 for light from afar, whose
// given illuminance is valid everywhere in the air.
inline float airTransmittance(const Scene& scene, const Emitter& emitter, vec3 point) {
  if (!scene.medium || emitter.type == kEmitterDirectional) return 1;
  const vec3 offset = point - emitter.position;
  const float way = length(offset);
  return way > 0 ? std::exp(-opticalDepth(*scene.medium, emitter.position, offset / way, way)) : 1.0f;
}

}  // namespace nephroid
