// Lamps with a size in parts, each as an emitter and points about it.
#pragma once

#include <array>
#include <vector>

#include "lights/emitters.h"

namespace nephroid {

// Points that stand for a part of a lamp, about its middle, so that none is far from any place in it.
struct LampPoints {
  std::vector<vec2> at;  // along the axes of the part
  float rest = 0;        // of the variance along an axis, what the places that one point stands for have
};

// The offsets of a part's places from its middle. None: a point.
struct LampSpread {
  // m; of light from afar by how much its direction (unit) turns. Of a ball seen along `toward`, unit.
  vec3 axis[2] = {vec3(0), vec3(0)};
  vec3 toward{0};
  bool isBall = false;
  vec2 deviation{0};                 // standard deviation of the places, along the axes
  std::array<LampPoints, 3> points;  // 4, 16 and 64 of them

  bool hasSize() const { return deviation.x > 0; }
  // The axes for light that travels along the unit vector `direction`: a ball is seen as a disk from
  // anywhere.
  std::array<vec3, 2> axesAcross(vec3 direction) const;
};

struct LampCell {
  Emitter emitter{};  // its middle, with its light
  LampSpread spread;
};

// The parts of a light with a size, for what is in a ball about `center` (m) of that radius: few enough, and
// each so small that light moves in proportion to the place on it. `index`: of the light in its scene. Gobos
// and profiles are not included.
std::vector<LampCell> lampCells(const Light& light, uint32_t index, vec3 center, float radius);

}  // namespace nephroid
