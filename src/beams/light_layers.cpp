#include "beams/light_layers.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "beams/share_out.h"

namespace nephroid {
namespace {

constexpr float kLeastApproach = 0.2f;  // cosine with the axis of light that is followed
constexpr float kMostSpread = 1;  // m that layers are wider than where light begins, for each m of depth

struct Axes {
  vec3 u, v, w;
  vec3 of(vec3 a) const { return {dot(a, u), dot(a, v), dot(a, w)}; }
};

Axes axesAcross(vec3 w) {
  const vec3 aside = std::abs(w.x) < 0.7f ? vec3(1, 0, 0) : vec3(0, 0, 1);
  const vec3 v = glm::normalize(glm::cross(w, aside));
  return {glm::cross(v, w), v, w};
}

float meanOf(vec3 v) {
  return (v.x + v.y + v.z) / 3;
}

// A beam along the axes.
struct LayerBeam {
  vec3 start[3];    // m
  vec2 slope[3];    // m across for each m along axisW
  float length[3];  // m of way for each m along axisW
  float end[3];     // m along axisW, where the corner's light ends
  float flux = 0;   // lm, mean of the channels
};

std::vector<LayerBeam> alongAxes(std::span<const Beam> beams, const Axes& axes, float farthest) {
  std::vector<LayerBeam> all;
  all.reserve(beams.size());
  for (const Beam& beam : beams) {
    LayerBeam own;
    bool goesAlong = true;
    for (int i = 0; i < 3; ++i) {
      const vec3 direction = axes.of(beam.direction[i]);
      goesAlong = goesAlong && direction.z >= kLeastApproach;
      own.start[i] = axes.of(beam.position[i]);
      own.slope[i] = vec2(direction) / direction.z;
      own.length[i] = 1 / direction.z;
      own.end[i] = own.start[i].z + std::min(beam.reach[i], farthest) * direction.z;
    }
    own.flux = meanOf(beam.flux);
    if (goesAlong && own.flux > 0) all.push_back(own);
  }
  return all;
}

// Where they cross the grid's depths, and which way most of their light goes.
LayerGrid gridOf(std::span<const LayerBeam> beams, const Axes& axes, const LayerSettings& settings) {
  constexpr float kFar = std::numeric_limits<float>::max();
  glm::dvec2 drift(0);
  double flux = 0;
  float first = kFar, last = -kFar;
  for (const LayerBeam& beam : beams)
    for (int i = 0; i < 3; ++i) {
      drift += double(beam.flux) * glm::dvec2(beam.slope[i]);
      flux += double(beam.flux);
      first = std::min(first, beam.start[i].z);
      last = std::max(last, beam.end[i]);
    }
  last = std::max(last, first + 1e-6f);
  LayerGrid grid{};
  grid.drift = vec2(drift / flux);
  vec2 low(kFar), high(-kFar), lowest(kFar), highest(-kFar);
  for (const LayerBeam& beam : beams)
    for (int i = 0; i < 3; ++i) {
      const vec2 start = vec2(beam.start[i]) - (beam.start[i].z - first) * grid.drift;
      const vec2 end = start + (beam.end[i] - beam.start[i].z) * (beam.slope[i] - grid.drift);
      low = glm::min(low, start);
      high = glm::max(high, start);
      lowest = glm::min(lowest, end);
      highest = glm::max(highest, end);
    }
  const float most = kMostSpread * (last - first);
  low = glm::max(glm::min(low, lowest), low - most);
  high = glm::min(glm::max(high, highest), high + most);
  const vec2 extent = high - low;
  grid.texelsPerMeter = float(settings.texels) / std::max({extent.x, extent.y, 1e-6f});
  grid.size = glm::floor(grid.texelsPerMeter * extent + 0.01f) + 1.0f;
  grid.layers = float(settings.layers);
  grid.layersPerMeter = (grid.layers - 1) / (last - first);
  grid.axisU = axes.u;
  grid.axisV = axes.v;
  grid.axisW = axes.w;
  grid.corner = low.x * axes.u + low.y * axes.v + first * axes.w;
  return grid;
}

// What beams leave on one layer, `depth` m along axisW.
void fillLayer(std::span<const LayerBeam> beams, const LayerGrid& grid, vec3 corner, float depth,
               float relief, std::span<vec4> texels) {
  std::vector<glm::dvec4> sums(texels.size(), glm::dvec4(0));
  glm::dvec4 light(0);
  const auto add = [&](std::size_t texel, double part) { sums[texel] += part * light; };
  const FootprintSharer sharer(uvec2(grid.size), add);
  const vec2 origin = vec2(corner) + (depth - corner.z) * grid.drift;
  const float spacing = 1.001f / grid.layersPerMeter;
  for (const LayerBeam& beam : beams) {
    vec2 at[3], slope(0);
    float lit = 0, way = 0, perDepth = 0;
    for (int i = 0; i < 3; ++i) {
      const float ahead = depth - beam.start[i].z;
      at[i] = grid.texelsPerMeter * (vec2(beam.start[i]) + ahead * beam.slope[i] - origin);
      if (ahead >= -relief - spacing && depth <= beam.end[i] + spacing) lit += 1.0f / 3;
      slope += beam.slope[i] / 3.0f;
      way += ahead * beam.length[i] / 3;
      perDepth += beam.length[i] / 3;
    }
    if (lit == 0) continue;
    // Lux across the light, of which the layer cuts a slant.
    light = double(lit * beam.flux * perDepth) * glm::dvec4(1, slope.x, slope.y, way);
    sharer.share(at[0], at[1], at[2]);
  }
  const double perArea = double(grid.texelsPerMeter) * double(grid.texelsPerMeter);
  std::ranges::transform(sums, texels.begin(), [&](const glm::dvec4& sum) { return vec4(perArea * sum); });
}

}  // namespace

LightLayers lightInLayers(std::span<const Beam> beams, vec3 axis, const LayerSettings& settings) {
  const Axes axes = axesAcross(axis);
  const std::vector<LayerBeam> along = alongAxes(beams, axes, settings.farthest);
  LightLayers light;
  if (along.empty()) return light;
  glm::dvec3 flux(0);
  for (const Beam& beam : beams) flux += glm::dvec3(beam.flux);
  light.color = vec3(flux * 3.0 / (flux.x + flux.y + flux.z));
  light.grid = gridOf(along, axes, settings);
  const LayerGrid& grid = light.grid;
  const std::size_t layerTexels = std::size_t(grid.size.x) * std::size_t(grid.size.y);
  light.texels.resize(settings.layers * layerTexels);
  const vec3 corner = axes.of(grid.corner);
  oneapi::tbb::parallel_for(0u, settings.layers, [&](uint32_t layer) {
    fillLayer(along, grid, corner, corner.z + float(layer) / grid.layersPerMeter, settings.relief,
              std::span(light.texels).subspan(layer * layerTexels, layerTexels));
  });
  return light;
}

}  // namespace nephroid
