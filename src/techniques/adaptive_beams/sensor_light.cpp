#include "techniques/adaptive_beams/sensor_light.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "beams/deposit.h"
#include "techniques/adaptive_beams/tile_deposit.h"

namespace nephroid {
namespace {

constexpr uint32_t kBandRows = 16;  // of texels that one task fills

struct Footprint {
  vec2 at[3];  // texels
};

// Bands that a footprint has light in; of none where `first` is after `last`.
struct Bands {
  int first = 0, last = -1;
};

Bands bandsOf(const Footprint& footprint, uint32_t bands) {
  const float low = std::min({footprint.at[0].y, footprint.at[1].y, footprint.at[2].y});
  const float high = std::max({footprint.at[0].y, footprint.at[1].y, footprint.at[2].y});
  const float last = float(bands) - 1;
  if (high < 0 || low >= float(bands * kBandRows)) return {};
  return {int(std::max(std::floor(low / kBandRows), 0.0f)),
          int(std::min(std::floor(high / kBandRows), last))};
}

void deposit(const RayMesh& mesh, const PlaneGrid& grid, uvec2 resolution, std::vector<float>& flux) {
  std::vector<Footprint> footprints(mesh.beams.size());
  const uint32_t bands = (resolution.y + kBandRows - 1) / kBandRows;
  std::vector<std::vector<uint32_t>> inBand(bands);
  for (uint32_t i = 0; i < footprints.size(); ++i) {
    for (int c = 0; c < 3; ++c) {
      const vec3 offset = mesh.beams[i].corner[c] - grid.corner;
      footprints[i].at[c] = {dot(offset, grid.axisU), dot(offset, grid.axisV)};
    }
    const Bands own = bandsOf(footprints[i], bands);
    for (int band = own.first; band <= own.last; ++band) inBand[std::size_t(band)].push_back(i);
  }
  oneapi::tbb::parallel_for(0u, bands, [&](uint32_t band) {
    const uint32_t firstRow = band * kBandRows, rows = std::min(kBandRows, resolution.y - firstRow);
    const vec2 corner(0, float(firstRow));
    float* red = flux.data() + std::size_t(firstRow) * resolution.x;
    const std::size_t plane = flux.size() / 3;
    thread_local TileDeposit tile;
    tile.begin({resolution.x, rows});
    for (const uint32_t i : inBand[band]) {
      const LandedBeam& beam = mesh.beams[i];
      const Footprint& f = footprints[i];
      tile.add(f.at[0] - corner, f.at[1] - corner, f.at[2] - corner, beam.density, beam.flux);
    }
    tile.addTo({red, red + plane, red + 2 * plane});
  });
}

}  // namespace

std::vector<vec3> lightOnSensor(const Scene& scene, const RayScene& rays, const Sensor& sensor,
                                const SensorAccuracy& accuracy, RayMesh& mesh, Progress& progress) {
  const float texels = float(sensor.resolution.x) * float(sensor.resolution.y);
  RayMeshSettings settings;
  settings.error = accuracy.error;
  settings.paths = accuracy.paths;
  settings.mostBytes = accuracy.mostBytes;
  settings.target = {true, gridOf(sensor)};
  settings.wantedHigh = vec2(sensor.resolution);
  settings.area = length(cross(sensor.u, sensor.v));
  settings.detailsOfPoint = 4;
  settings.detail = std::sqrt(settings.area / texels) / settings.detailsOfPoint;
  traceRayMesh(scene, rays, settings, progress, mesh);
  const std::size_t count = std::size_t(sensor.resolution.x) * sensor.resolution.y;
  std::vector<float> flux(3 * count, 0);
  deposit(mesh, settings.target.plane, sensor.resolution, flux);
  std::vector<vec3> lux(count);
  for (std::size_t i = 0; i < count; ++i)
    lux[i] = vec3(flux[i], flux[count + i], flux[2 * count + i]) * (texels / settings.area);
  return lux;
}

}  // namespace nephroid
