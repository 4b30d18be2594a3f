#include "water/water.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "geometry/shape_grid.h"
#include "water/ocean.h"
#include "water/wave_simulation.h"

namespace nephroid {
namespace {

using glm::dvec2;

// A grid of values by where they stand, x fastest.
template <class Value>
struct OnGrid {
  const std::vector<Value>& values;
  uvec2 grid;
  dvec2 spacing;  // m

  Value at(uint32_t x, uint32_t z) const { return values[std::size_t{z} * grid.x + x]; }
  // d/dx and d/dz, across one vertex to each side as far as there is one.
  Value alongX(uint32_t x, uint32_t z) const {
    const uint32_t from = x > 0 ? x - 1 : x, to = x + 1 < grid.x ? x + 1 : x;
    return (at(to, z) - at(from, z)) / (double(to - from) * spacing.x);
  }
  Value alongZ(uint32_t x, uint32_t z) const {
    const uint32_t from = z > 0 ? z - 1 : z, to = z + 1 < grid.y ? z + 1 : z;
    return (at(x, to) - at(x, from)) / (double(to - from) * spacing.y);
  }
};

WaterPoint pointOf(const Wave& wave, dvec2 xz, double time) {
  const dvec2 direction = wave.direction;
  const double k = kTurn / wave.wavelength;
  const double argument = k * (glm::dot(direction, xz) - wave.speed * time) + wave.phase;
  return {wave.amplitude * std::sin(argument), wave.amplitude * k * std::cos(argument) * direction};
}

// Straight lines between samples of a wave's slope are a twelfth of this too flat in the mean, and rise or
// fall a twenty-fourth too little. Slopes that are greater by a sixteenth bring light near to where the wave
// itself sends it.
double squaredPhaseBetweenSamples(const Wave& wave, dvec2 spacing) {
  const dvec2 phase = kTurn / wave.wavelength * dvec2(wave.direction) * spacing;
  return glm::dot(phase, phase);
}

void addWaves(const Water& water, double time, dvec2 spacing, std::vector<ShapePoint>& points,
              std::vector<dvec2>& slopes) {
  for (const Wave& wave : water.waves) {
    const double scale = 1 + std::min(squaredPhaseBetweenSamples(wave, spacing), 1.0) / 16;
    for (std::size_t i = 0; i < points.size(); ++i) {
      dvec3& position = points[i].position;
      const WaterPoint point = pointOf(wave, {position.x, position.z}, time);
      position.y += point.height;
      slopes[i] += scale * point.slope;
    }
  }
}

void addSimulation(const std::vector<double>& heights, const Water& water, dvec2 spacing,
                   std::vector<ShapePoint>& points, std::vector<dvec2>& slopes) {
  const OnGrid<double> grid{heights, water.grid, spacing};
  for (uint32_t z = 0, i = 0; z < water.grid.y; ++z)
    for (uint32_t x = 0; x < water.grid.x; ++x, ++i) {
      points[i].position.y += heights[i];
      slopes[i] += dvec2(grid.alongX(x, z), grid.alongZ(x, z));
    }
}

// Across the surface that `slopes` and the sea's offsets make.
void setNormals(const Water& water, const std::vector<dvec2>& offsets, dvec2 spacing,
                const std::vector<dvec2>& slopes, std::vector<ShapePoint>& points) {
  const OnGrid<dvec2> grid{offsets, water.grid, spacing};
  for (uint32_t z = 0, i = 0; z < water.grid.y; ++z)
    for (uint32_t x = 0; x < water.grid.x; ++x, ++i) {
      const dvec2 alongX = offsets.empty() ? dvec2(0) : grid.alongX(x, z),
                  alongZ = offsets.empty() ? dvec2(0) : grid.alongZ(x, z);
      points[i].normal = glm::normalize(
          glm::cross(dvec3(alongZ.x, slopes[i].y, 1 + alongZ.y), dvec3(1 + alongX.x, slopes[i].x, alongX.y)));
    }
}

std::vector<ShapePoint> surfacePoints(const Water& water, double time, WaveRun& run) {
  const dvec2 half = 0.5 * dvec2(water.size);
  const uvec2 cells = water.grid - 1u;
  const dvec2 spacing = dvec2(water.size) / dvec2(cells);
  std::vector<ShapePoint> points;
  for (uint32_t z = 0; z <= cells.y; ++z)
    for (uint32_t x = 0; x <= cells.x; ++x)
      points.push_back({{between(-half.x, half.x, x, cells.x), 0, between(-half.y, half.y, z, cells.y)}, {}});
  std::vector<dvec2> slopes(points.size(), dvec2(0)), offsets;
  addWaves(water, time, spacing, points, slopes);
  if (water.simulation) addSimulation(run.heightsAt(water, time), water, spacing, points, slopes);
  if (water.ocean) {
    OceanSurface sea = oceanSurface(water, time);
    offsets = std::move(sea.offsets);
    for (std::size_t i = 0; i < points.size(); ++i) {
      points[i].position += dvec3(offsets[i].x, sea.heights[i], offsets[i].y);
      slopes[i] += sea.slopes[i];
    }
  }
  setNormals(water, offsets, spacing, slopes, points);
  return points;
}

}  // namespace

WaterPoint waterAt(const Water& water, glm::dvec2 xz, double time) {
  WaterPoint point{0, glm::dvec2(0)};
  for (const Wave& wave : water.waves) {
    const WaterPoint one = pointOf(wave, xz, time);
    point.height += one.height;
    point.slope += one.slope;
  }
  return point;
}

Mesh makeWater(const Water& water, double time, WaveRun* run) {
  WaveRun fresh;
  const uvec2 cells = water.grid - 1u;
  Mesh mesh;
  mesh.name = "water";
  for (const ShapePoint& point : surfacePoints(water, time, run ? *run : fresh)) addVertex(mesh, point);
  for (uint32_t j = 0; j < cells.y; ++j) {
    for (uint32_t i = 0; i < cells.x; ++i) {
      const uint32_t a = j * water.grid.x + i, b = a + 1, d = a + water.grid.x, c = d + 1;
      mesh.triangles.emplace_back(a, d, b);
      mesh.triangles.emplace_back(b, d, c);
    }
  }
  mesh.isFinished = true;
  mesh.isCurved = true;
  return mesh;
}

}  // namespace nephroid
