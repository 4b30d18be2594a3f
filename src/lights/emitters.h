// The points and directions that stand for a light where it is sampled.
#pragma once

#include <vector>

#include "lights/emitter.h"
#include "scene/scene.h"

namespace nephroid {

// The parameters of coneFalloff.
struct SpotCone {
  float scale = 0;
  float offset = 1;
};

SpotCone coneOf(const Light& light);

// The position (m) of a light; for a line or an area its middle. Without meaning for light from afar.
inline vec3 middleOf(const Light& light) {
  if (light.type == LightType::line) return 0.5f * (light.position + light.end);
  return light.type == LightType::area ? light.position + 0.5f * (light.u + light.v) : light.position;
}

// A light as a single emitter, without the extent of a line or an area, and without gobo and profile
// (light_intensity.h). Not for a sky. `index`: of the light in its scene.
Emitter lampOf(const Light& light, uint32_t index = 0);

// A part of a sky. `index`: of the light in its scene.
Emitter emitterOf(const Light& sky, uint32_t index, const SkyPart& part);

// Emitters that differ only in position, each one `step` (m) after the one before.
struct EmitterRow {
  Emitter first{};
  vec3 step{0};
  uint32_t count = 1;
};

// The emitters of a light; `index` is its index in the scene. The points of a line are one row, each in the
// middle of its part of the line. The points of an area and the parts of a sky are rows of one emitter each.
// Gobos and profiles are not included (light_intensity.h).
std::vector<EmitterRow> emitterRowsOf(const Light& light, uint32_t index = 0);
std::vector<EmitterRow> emitterRowsOf(const Scene& scene);

// The same as single emitters.
std::vector<Emitter> emittersOf(const Light& light, uint32_t index = 0);
std::vector<Emitter> emittersOf(const Scene& scene);

}  // namespace nephroid
