#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "optics/emitter.h"
#include "scene/scene.h"

namespace nephroid {

// The emitters light `light` stands for: one, or `samples` points of equal share along a line, each at the
// middle of its part.
inline std::vector<Emitter> emittersOf(const Light& light) {
  Emitter emitter{};
  emitter.position = light.position;
  emitter.direction = light.direction;
  emitter.power = light.intensity;
  switch (light.type) {
    case LightType::directional:
      emitter.type = kEmitterDirectional;
      emitter.power = light.illuminance;
      return {emitter};
    case LightType::point:
      emitter.type = kEmitterPoint;
      return {emitter};
    case LightType::spot: {
      emitter.type = kEmitterSpot;
      const float cosInner = std::cos(glm::radians(light.innerAngle));
      const float cosOuter = std::cos(glm::radians(light.outerAngle));
      emitter.coneScale = 1 / std::max(0.001f, cosInner - cosOuter);
      emitter.coneOffset = -cosOuter * emitter.coneScale;
      return {emitter};
    }
    case LightType::line:
      break;
  }
  emitter.type = kEmitterPoint;
  emitter.power = light.intensity / float(light.samples);
  std::vector<Emitter> points(light.samples, emitter);
  for (uint32_t i = 0; i < light.samples; ++i)
    points[i].position = glm::mix(light.position, light.end, (float(i) + 0.5f) / float(light.samples));
  return points;
}

inline std::vector<Emitter> emittersOf(const Scene& scene) {
  std::vector<Emitter> all;
  for (const Light& light : scene.lights) {
    const std::vector<Emitter> some = emittersOf(light);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace nephroid
