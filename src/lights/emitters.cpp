#include "lights/emitters.h"

#include <algorithm>
#include <cmath>

#include "lights/sky.h"

namespace nephroid {
namespace {

std::vector<EmitterRow> rowsOfArea(const Light& light, Emitter emitter) {
  emitter.power = light.intensity / float(light.grid.x * light.grid.y);
  std::vector<EmitterRow> rows;
  for (uint32_t y = 0; y < light.grid.y; ++y)
    for (uint32_t x = 0; x < light.grid.x; ++x) {
      const vec2 at = (vec2(float(x), float(y)) + 0.5f) / vec2(light.grid);
      emitter.position = light.position + at.x * light.u + at.y * light.v;
      rows.push_back({emitter});
    }
  return rows;
}

template <class Element>
std::vector<Element> ofAllLights(const Scene& scene,
                                 std::vector<Element> (*ofLight)(const Light&, uint32_t)) {
  std::vector<Element> all;
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    const std::vector<Element> some = ofLight(scene.lights[i], i);
    all.insert(all.end(), some.begin(), some.end());
  }
  return all;
}

}  // namespace

SpotCone coneOf(const Light& light) {
  if (light.outerAngle >= 180) return {};
  const float cosInner = std::cos(glm::radians(light.innerAngle));
  const float cosOuter = std::cos(glm::radians(light.outerAngle));
  const float scale = 1 / std::max(0.001f, cosInner - cosOuter);
  return {scale, -cosOuter * scale};
}

Emitter lampOf(const Light& light, uint32_t index) {
  Emitter lamp{};
  lamp.light = index;
  lamp.type = kEmitterPoint;
  lamp.position = light.position;
  lamp.direction = light.direction;
  lamp.power = light.intensity;
  if (light.type == LightType::directional) {
    lamp.type = kEmitterDirectional;
    lamp.power = light.illuminance;
  } else if (light.type == LightType::spot) {
    const SpotCone cone = coneOf(light);
    lamp.type = kEmitterSpot;
    lamp.coneScale = cone.scale;
    lamp.coneOffset = cone.offset;
  } else if (light.type == LightType::area) {
    lamp.type = kEmitterPanel;
  }
  return lamp;
}

Emitter emitterOf(const Light& sky, uint32_t index, const SkyPart& part) {
  Emitter emitter = lampOf(sky, index);
  emitter.type = kEmitterDirectional;
  emitter.direction = skyTurned(sky.skyRotation) * part.direction;
  emitter.power = sky.intensity * part.illuminance;
  return emitter;
}

std::vector<EmitterRow> emitterRowsOf(const Light& light, uint32_t index) {
  Emitter emitter = lampOf(light, index);
  switch (light.type) {
    case LightType::line: {
      const vec3 step = (light.end - light.position) / float(light.samples);
      emitter.power = light.intensity / float(light.samples);
      emitter.position = light.position + 0.5f * step;
      return {{emitter, step, light.samples}};
    }
    case LightType::area:
      return rowsOfArea(light, emitter);
    case LightType::sky: {
      std::vector<EmitterRow> rows;
      for (const SkyPart& part : light.sky) rows.push_back({emitterOf(light, index, part)});
      return rows;
    }
    default:
      return {{emitter}};
  }
}

std::vector<EmitterRow> emitterRowsOf(const Scene& scene) {
  return ofAllLights<EmitterRow>(scene, emitterRowsOf);
}

std::vector<Emitter> emittersOf(const Light& light, uint32_t index) {
  std::vector<Emitter> all;
  for (const EmitterRow& row : emitterRowsOf(light, index)) {
    all.insert(all.end(), row.count, row.first);
    for (uint32_t i = 1; i < row.count; ++i)
      (all.end() - row.count + i)->position = row.first.position + float(i) * row.step;
  }
  return all;
}

std::vector<Emitter> emittersOf(const Scene& scene) {
  return ofAllLights<Emitter>(scene, emittersOf);
}

}  // namespace nephroid
