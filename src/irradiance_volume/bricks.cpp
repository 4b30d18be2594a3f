#include "irradiance_volume/bricks.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "irradiance_volume/grid.h"

namespace nephroid {
namespace {

constexpr uint32_t kLevels = 4;  // a brick has 1, 2, 4 or 8 intervals along its sides
static_assert(1u << (kLevels - 1) == kBrickIntervals);

// Values at the corners of the bricks' intervals, of all bricks.
struct Lattice {
  uvec3 size{0};
  std::vector<CellSum> values;
  CellSum& at(uvec3 p) { return values[(std::size_t{p.z} * size.y + p.y) * size.x + p.x]; }
  const CellSum& at(uvec3 p) const { return values[(std::size_t{p.z} * size.y + p.y) * size.x + p.x]; }
};

void add(CellSum& sum, float weight, const CellSum& value) {
  sum.vector += weight * value.vector;
  sum.color += weight * value.color;
}

// Every other value, as the mean around it that leaves the sum of all as it is.
Lattice halved(const Lattice& fine) {
  Lattice coarse{(fine.size - 1u) / 2u + 1u, {}};
  coarse.values.resize(std::size_t{coarse.size.x} * coarse.size.y * coarse.size.z);
  for (uint32_t z = 0; z < coarse.size.z; ++z)
    for (uint32_t y = 0; y < coarse.size.y; ++y)
      for (uint32_t x = 0; x < coarse.size.x; ++x) {
        CellSum& mean = coarse.at({x, y, z});
        float weights = 0;
        for (int i = 0; i < 27; ++i) {
          const ivec3 offset(i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1);
          const ivec3 place = 2 * ivec3(uvec3(x, y, z)) + offset;
          if (glm::any(glm::lessThan(place, ivec3(0))) ||
              glm::any(glm::greaterThanEqual(place, ivec3(fine.size))))
            continue;
          const float weight = 1 / float(1 << (std::abs(offset.x) + std::abs(offset.y) + std::abs(offset.z)));
          add(mean, weight, fine.at(uvec3(place)));
          weights += weight;
        }
        mean.vector /= weights;
        mean.color /= weights;
      }
  return coarse;
}

// Of the brick, by its values of a lattice with `intervals` along its sides; `place` from 0 to
// kBrickIntervals.
vec3 vectorIn(const Lattice& lattice, uvec3 brick, uint32_t intervals, uvec3 place) {
  const vec3 at = vec3(place) * (float(intervals) / float(kBrickIntervals));
  const uvec3 corner = glm::min(uvec3(at), uvec3(intervals - 1));
  const vec3 part = at - vec3(corner);
  vec3 sum(0);
  for (uint32_t i = 0; i < 8; ++i) {
    const uvec3 bit(i & 1u, (i >> 1) & 1u, i >> 2);
    const vec3 weights = mix(1.0f - part, part, vec3(bit));
    sum += weights.x * weights.y * weights.z * lattice.at(brick * intervals + corner + bit).vector;
  }
  return sum;
}

// What a brick's light adds up to, between its values.
vec3 sumIn(const Lattice& lattice, uvec3 brick, uint32_t intervals) {
  vec3 sum(0);
  for (uint32_t z = 0; z <= intervals; ++z)
    for (uint32_t y = 0; y <= intervals; ++y)
      for (uint32_t x = 0; x <= intervals; ++x) {
        float weight = 1;
        for (const uint32_t at : {x, y, z}) weight *= at == 0 || at == intervals ? 0.5f : 1.0f;
        sum += weight * lattice.at(brick * intervals + uvec3(x, y, z)).vector;
      }
  return sum / std::pow(float(intervals), 3.0f);
}

// What a coarse brick's values are to be multiplied by, by component, to hold as much light as the finest:
// what it took from bricks around it, they may have kept too.
vec3 keepingLight(const std::array<Lattice, kLevels>& lattices, uvec3 brick, uint32_t level) {
  constexpr float kMost = 4;
  const vec3 fine = sumIn(lattices[kLevels - 1], brick, kBrickIntervals);
  const vec3 coarse = sumIn(lattices[level], brick, 1u << level);
  vec3 scale(1);
  for (int axis = 0; axis < 3; ++axis)
    if (fine[axis] * coarse[axis] > 0) scale[axis] = std::clamp(fine[axis] / coarse[axis], 1 / kMost, kMost);
  return scale;
}

float errorOf(const std::array<Lattice, kLevels>& lattices, uvec3 brick, uint32_t level) {
  const vec3 scale = keepingLight(lattices, brick, level);
  double sum = 0;
  for (uint32_t z = 0; z <= kBrickIntervals; ++z)
    for (uint32_t y = 0; y <= kBrickIntervals; ++y)
      for (uint32_t x = 0; x <= kBrickIntervals; ++x) {
        const vec3 difference = scale * vectorIn(lattices[level], brick, 1u << level, {x, y, z}) -
                                lattices[kLevels - 1].at(brick * kBrickIntervals + uvec3(x, y, z)).vector;
        sum += double(dot(difference, difference));
      }
  return float(std::sqrt(sum / std::pow(kBrickIntervals + 1, 3)));
}

bool isDark(const Lattice& finest, uvec3 brick) {
  for (uint32_t i = 0; i < 729; ++i)
    if (finest.at(brick * kBrickIntervals + uvec3(i % 9, i / 9 % 9, i / 81)).color != vec3(0)) return false;
  return true;
}

void appendBrick(const std::array<Lattice, kLevels>& lattices, uvec3 brick, uint32_t level,
                 std::vector<uint32_t>& words) {
  const uint32_t intervals = 1u << level;
  const vec3 scale = keepingLight(lattices, brick, level);
  for (uint32_t z = 0; z <= intervals; ++z)
    for (uint32_t y = 0; y <= intervals; ++y)
      for (uint32_t x = 0; x <= intervals; ++x) {
        words.resize(words.size() + kWordsOfCell);
        const CellSum& value = lattices[level].at(brick * intervals + uvec3(x, y, z));
        packCell({scale * value.vector, value.color}, &words[words.size() - kWordsOfCell]);
      }
}

}  // namespace

VolumeSample brickSample(std::span<const PhotonPath> paths, std::size_t finestBytes, float bound) {
  VolumeSample sample;
  if (paths.empty()) return sample;
  SampleLayout finest = gridAround(litBox(paths), finestBytes / (kWordsOfCell * sizeof(uint32_t)));
  const uvec3 bricks = (max(finest.size, uvec3(2)) - 2u) / kBrickIntervals + 1u;
  finest.size = bricks * kBrickIntervals + 1u;
  std::array<Lattice, kLevels> lattices;
  lattices[kLevels - 1] = {finest.size, gridSums(paths, finest)};
  for (uint32_t level = kLevels - 1; level > 0; --level) lattices[level - 1] = halved(lattices[level]);

  sample.words.resize((std::size_t{bricks.x} * bricks.y * bricks.z + 1) / kWordsOfCell * kWordsOfCell);
  std::size_t index = 0;
  for (uint32_t z = 0; z < bricks.z; ++z)
    for (uint32_t y = 0; y < bricks.y; ++y)
      for (uint32_t x = 0; x < bricks.x; ++x, ++index) {
        const uvec3 brick(x, y, z);
        if (isDark(lattices[kLevels - 1], brick)) {
          sample.words[index] = kDarkBrick;
          continue;
        }
        uint32_t level = 0;
        while (level < kLevels - 1 && errorOf(lattices, brick, level) > bound) ++level;
        sample.words[index] = uint32_t(sample.words.size() / kWordsOfCell) << 2 | level;
        appendBrick(lattices, brick, level, sample.words);
      }
  sample.layout = {finest.corner, finest.placesPerUnit, bricks, uint32_t(sample.words.size())};
  return sample;
}

}  // namespace nephroid
