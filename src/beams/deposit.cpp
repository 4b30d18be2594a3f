#include "beams/deposit.h"

#include <oneapi/tbb/parallel_for.h>

#include "beams/share_out.h"

namespace nephroid {
namespace {

constexpr std::size_t kParts = 16;  // fixed, so that sums are added in the same order on every machine

template <class Sharer>
void shareOut(const Beam& beam, const PlaneGrid& grid, const Sharer& sharer) {
  vec2 texel[3];
  bool meets[3];
  float distance;
  for (int i = 0; i < 3; ++i)
    meets[i] = meetPlane(beam.position[i], beam.direction[i], grid, texel[i], distance);
  if (meets[0] && meets[1] && meets[2]) return sharer.share(texel[0], texel[1], texel[2]);
  for (int i = 0; i < 3; ++i)
    if (meets[i]) sharer.addAt(texel[i], 1.0 / 3);
}

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
    glm::dvec3 flux(0);
    const auto add = [&](std::size_t texel, double share) { parts[part][texel] += flux * share; };
    const FootprintSharer sharer(resolution, add);
    const std::size_t end = beams.size() * (part + 1) / kParts;
    for (std::size_t i = beams.size() * part / kParts; i < end; ++i) {
      flux = glm::dvec3(beams[i].flux);
      shareOut(beams[i], grid, sharer);
    }
  });
  for (std::size_t part = 1; part < kParts; ++part)
    for (std::size_t i = 0; i < texelCount; ++i) parts[0][i] += parts[part][i];
  return std::move(parts[0]);
}

}  // namespace nephroid
