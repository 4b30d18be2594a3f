// What lights are replaced by where they are sampled: points and directions.
#pragma once

#include <vector>

#include "lights/emitter.h"
#include "scene/scene.h"

namespace nephroid {

// What coneFalloff takes besides the angle.
struct SpotCone {
  float scale = 0;
  float offset = 1;
};

SpotCone coneOf(const Light& light);

// m. Of a line or an area the middle; without meaning for light from afar.
inline vec3 middleOf(const Light& light) {
  if (light.type == LightType::line) return 0.5f * (light.position + light.end);
  return light.type == LightType::area ? light.position + 0.5f * (light.u + light.v) : light.position;
}

// A light as one emitter: all that it is but for a line's and an area's extent, for gobo and profile
// (light_intensity.h), and for a sky, which is not one. `index`: of its scene.
Emitter lampOf(const Light& light, uint32_t index = 0);

// Emitters that differ in their place alone, one `step` (m) after another.
struct EmitterRow {
  Emitter first{};
  vec3 step{0};
  uint32_t count = 1;
};

// What light `light` stands for, which is the `index`-th of its scene. Points of a line in one row, each at
// the middle of its part; of an area, likewise, and of a sky each a row of its own. Gobos and profiles are
// not in them (light_intensity.h).
std::vector<EmitterRow> emitterRowsOf(const Light& light, uint32_t index = 0);
std::vector<EmitterRow> emitterRowsOf(const Scene& scene);

// The same, one by one.
std::vector<Emitter> emittersOf(const Light& light, uint32_t index = 0);
std::vector<Emitter> emittersOf(const Scene& scene);

}  // namespace nephroid
