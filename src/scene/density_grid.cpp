#include "scene/density_grid.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "geometry/box.h"

namespace nephroid {
namespace {

float largest(vec3 v) {
  return std::max({v.x, v.y, v.z});
}
float smallest(vec3 v) {
  return std::min({v.x, v.y, v.z});
}

// 0 to 1 (Wang 2007).
float latticeValue(ivec3 cell, uint32_t seed) {
  uint32_t hash = seed;
  for (const int i : {cell.x, cell.y, cell.z}) {
    hash = (hash ^ uint32_t(i)) * 0x9e3779b1u;
    hash = (hash ^ (hash >> 15)) * 0x85ebca6bu;
    hash ^= hash >> 13;
  }
  return float(hash >> 8) / float(1u << 24);
}

float valueNoise(vec3 place, uint32_t seed) {
  const vec3 low = floor(place), part = place - low;
  const vec3 smooth = part * part * (3.0f - 2.0f * part);
  const ivec3 cell(low);
  float sum = 0;
  for (int corner = 0; corner < 8; ++corner) {
    const ivec3 step(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    const vec3 weight = mix(1.0f - smooth, smooth, vec3(step));
    sum += weight.x * weight.y * weight.z * latticeValue(cell + step, seed);
  }
  return sum;
}

}  // namespace

float densityAt(const DensityGrid& grid, vec3 point) {
  const vec3 place = (point - grid.corner) / grid.size;
  if (smallest(place) < 0 || largest(place) > 1) return 0;
  const vec3 last = vec3(grid.cells - 1u);
  const vec3 at = glm::clamp(place * vec3(grid.cells) - 0.5f, vec3(0), last);
  const uvec3 low = uvec3(min(floor(at), max(last - 1.0f, vec3(0))));
  const vec3 part = at - vec3(low);
  const uvec3 high = min(low + 1u, grid.cells - 1u);
  const auto row = [&](uint32_t y, uint32_t z) {
    const float* values = grid.densities.data() + (std::size_t(z) * grid.cells.y + y) * grid.cells.x;
    return mix(values[low.x], values[high.x], part.x);
  };
  return mix(mix(row(low.y, low.z), row(high.y, low.z), part.y),
             mix(row(low.y, high.z), row(high.y, high.z), part.y), part.z);
}

float densityAlong(const DensityGrid& grid, vec3 from, vec3 direction, float length) {
  const vec2 part = wayThroughBox(grid.corner, grid.corner + grid.size, from, direction, length);
  if (!(part.y > part.x)) return 0;
  const float cell = smallest(grid.size / vec3(grid.cells));
  const auto steps = static_cast<uint32_t>(std::ceil(2 * (part.y - part.x) / cell));
  const float step = (part.y - part.x) / float(steps);
  float sum = 0;
  for (uint32_t i = 0; i < steps; ++i)
    sum += densityAt(grid, from + (part.x + (float(i) + 0.5f) * step) * direction);
  return sum * step;
}

void fillWithNoise(DensityGrid& grid, const NoiseSettings& settings) {
  grid.densities.resize(std::size_t{grid.cells.x} * grid.cells.y * grid.cells.z);
  oneapi::tbb::parallel_for(0u, grid.cells.z, [&](uint32_t z) {
    for (uint32_t y = 0; y < grid.cells.y; ++y)
      for (uint32_t x = 0; x < grid.cells.x; ++x) {
        const vec3 place = (vec3(x, y, z) + 0.5f) / vec3(grid.cells) * grid.size / settings.feature;
        float sum = 0, weights = 0, weight = 1, frequency = 1;
        for (uint32_t octave = 0; octave < settings.octaves; ++octave) {
          sum += weight * valueNoise(frequency * place, settings.seed + octave);
          weights += weight;
          weight /= 2;
          frequency *= 2;
        }
        grid.densities[(std::size_t(z) * grid.cells.y + y) * grid.cells.x + x] =
            std::max(sum / weights - settings.clear, 0.0f) / (1 - settings.clear);
      }
  });
}

}  // namespace nephroid
