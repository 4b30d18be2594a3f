// Lamps with a size in parts, each as an emitter and points about it.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "lights/emitters.h"

namespace nephroid {

inline constexpr uint32_t kFewLampPlaces = 4, kLampPlaces = 16, kManyLampPlaces = 64;

// The places of a part of a lamp, as offsets from its middle. None: a point.
struct LampSpread {
  // m; of light from afar by how much its direction (unit) turns. Of a ball seen along `toward`, unit.
  vec3 axis[2] = {vec3(0), vec3(0)};
  vec3 toward{0};
  bool isBall = false;
  bool isLine = false;
  bool isOneOfMore = false;  // parts of the lamp
  vec2 deviation{0};         // standard deviation of the places, along the axes
  // So that none is far from one, in units of the deviation: with the mean and the variance of all.
  std::array<vec2, kFewLampPlaces> fewPlaces{};
  std::array<vec2, kLampPlaces> places{};
  std::array<vec2, kManyLampPlaces> manyPlaces{};

  bool hasSize() const { return deviation.x > 0; }
  // The axes for light that travels along the unit vector `direction`: a ball is seen as a disk from
  // anywhere.
  std::array<vec3, 2> axesAcross(vec3 direction) const;
  // Of the variance along an axis, that of the places that one stands for where there are `count`.
  float restOf(std::size_t count) const { return 1 / float(isLine ? count * count : count); }
};

struct LampCell {
  Emitter emitter{};  // its middle, with its light
  LampSpread spread;
};

// The parts of a light with a size, for what is in a ball about `center` (m) of that radius: few, and each so
// small that light moves nearly in proportion to the place on it; more for a smaller `error` (of the mean).
// `index`: of the light in its scene. Gobos and profiles are not included.
std::vector<LampCell> lampCells(const Light& light, uint32_t index, vec3 center, float radius, float error);

// `parts`: of its map.
std::vector<LampCell> skyCells(const Light& light, uint32_t index, std::span<const SkyPart> parts);

// Skies in as many parts as an error asks for. They are kept, so that a sky is not cut anew for each picture.
class CutSkies {
 public:
  // `error`: of the mean; but no more than `most` parts. They are there until the next call.
  std::span<const SkyPart> partsOf(const SkyMap& map, float error, uint32_t most);

 private:
  struct Cut {
    uint64_t map = 0;  // a hash of its luminances
    uvec2 size{0};
    float error = 0;
    uint32_t most = 0;
    std::vector<SkyPart> parts;
  };
  std::vector<Cut> cuts_;  // the last used one first
};

}  // namespace nephroid
