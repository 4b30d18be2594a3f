#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "optics/emitter.h"
#include "scene/scene.h"

namespace nephroid {

// What coneFalloff takes besides the angle.
struct SpotCone {
  float scale = 0;
  float offset = 1;
};

inline SpotCone coneOf(const Light& light) {
  if (light.outerAngle >= 180) return {};
  const float cosInner = std::cos(glm::radians(light.innerAngle));
  const float cosOuter = std::cos(glm::radians(light.outerAngle));
  const float scale = 1 / std::max(0.001f, cosInner - cosOuter);
  return {scale, -cosOuter * scale};
}

// The emitters light `light` stands for, which is the `index`-th of its scene: one, or `samples` points of
// equal share along a line, each at the middle of its part. Gobos and profiles are not in them
// (light_intensity.h).
inline std::vector<Emitter> emittersOf(const Light& light, uint32_t index = 0) {
  Emitter emitter{};
  emitter.light = index;
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
      const SpotCone cone = coneOf(light);
      emitter.coneScale = cone.scale;
      emitter.coneOffset = cone.offset;
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
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    const std::vector<Emitter> some = emittersOf(scene.lights[i], i);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace nephroid
