#include "beams/deposit.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace nephroid {
namespace {

constexpr std::size_t kParts = 16;  // fixed, so that sums are added in the same order on every machine

class FluxGrid {
 public:
  FluxGrid(uvec2 size, std::vector<glm::dvec3>& texelsOf) : resolution(size), texels(texelsOf) {}

  void add(vec2 texel, glm::dvec3 flux) {
    const float x = std::floor(texel.x), y = std::floor(texel.y);
    if (x < 0 || y < 0 || x >= float(resolution.x) || y >= float(resolution.y)) return;
    texels[std::size_t(y) * resolution.x + std::size_t(x)] += flux;
  }

  void addSliver(vec2 a, vec2 b, vec2 c, glm::dvec3 flux) {
    const float peak = sortSliver(a, b, c);
    const vec2 along = c - a;
    const int steps = sliverSteps(a, c);
    double before = 0;
    for (int i = 0; i < steps; ++i) {
      const double after = tentBefore(float(i + 1) / float(steps), peak);
      add(a + (float(i) + 0.5f) / float(steps) * along, flux * (after - before));
      before = after;
    }
  }

  void addTriangle(vec2 a, vec2 b, vec2 c, glm::dvec3 flux) {
    const vec2 lower = floor(min(min(a, b), c));
    const vec2 upper = floor(max(max(a, b), c));
    if (lower == upper) return add(lower, flux);
    vec2 localA = a, localB = b, localC = c, base;
    centerFootprint(localA, localB, localC, base);
    if (isSliver(localA, localB, localC)) return addSliver(a, b, c, flux);
    const double area = 0.5 * std::abs(doubledArea(localA, localB, localC));
    const vec3 slopes = sideSlopes(localA, localB, localC);
    const vec2 last = min(upper, vec2(resolution) - 1.0f);
    for (float y = std::max(lower.y, 0.0f); y <= last.y; ++y) {
      const TriangleRow row = triangleInRow(localA, localB, localC, slopes, y - base.y);
      const float lastX = std::min(std::floor(row.last) + base.x, last.x);
      for (float x = std::max(std::floor(row.first) + base.x, 0.0f); x <= lastX; ++x)
        add(vec2(x, y), flux * (triangleCoverage(row, x - base.x) / area));
    }
  }

  void addBeam(const Beam& beam, const PlaneGrid& grid) {
    vec2 texel[3];
    bool meets[3];
    float distance;
    for (int i = 0; i < 3; ++i)
      meets[i] = meetPlane(beam.position[i], beam.direction[i], grid, texel[i], distance);
    const glm::dvec3 flux(beam.flux);
    if (meets[0] && meets[1] && meets[2]) return addTriangle(texel[0], texel[1], texel[2], flux);
    for (int i = 0; i < 3; ++i)
      if (meets[i]) add(texel[i], flux / 3.0);
  }

 private:
  uvec2 resolution;
  std::vector<glm::dvec3>& texels;
};

}  // namespace

PlaneGrid gridOf(const Sensor& sensor) {
  PlaneGrid grid;
  grid.corner = sensor.corner;
  grid.normal = -sensor.normal();
  // The dual basis, so that u and v need not be at right angles.
  const vec3 uNormal = cross(sensor.v, grid.normal);
  const vec3 vNormal = cross(sensor.u, grid.normal);
  grid.axisU = uNormal * (float(sensor.resolution.x) / dot(uNormal, sensor.u));
  grid.axisV = vNormal * (float(sensor.resolution.y) / dot(vNormal, sensor.v));
  return grid;
}

std::vector<glm::dvec3> depositFlux(std::span<const Beam> beams, const PlaneGrid& grid, uvec2 resolution) {
  const std::size_t texelCount = std::size_t(resolution.x) * resolution.y;
  std::vector<std::vector<glm::dvec3>> parts(kParts);
  oneapi::tbb::parallel_for(std::size_t{0}, kParts, [&](std::size_t part) {
    parts[part].assign(texelCount, glm::dvec3(0));
    FluxGrid flux(resolution, parts[part]);
    const std::size_t end = beams.size() * (part + 1) / kParts;
    for (std::size_t i = beams.size() * part / kParts; i < end; ++i) flux.addBeam(beams[i], grid);
  });
  for (std::size_t part = 1; part < kParts; ++part)
    for (std::size_t i = 0; i < texelCount; ++i) parts[0][i] += parts[part][i];
  return std::move(parts[0]);
}

}  // namespace nephroid
