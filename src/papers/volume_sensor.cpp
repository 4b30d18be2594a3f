#include "papers/volume_sensor.h"

#include <algorithm>
#include <cmath>

#include "reference/sensor.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

const Object& casterOf(const Scene& scene) {
  return *std::ranges::find_if(scene.objects, [&](const Object& object) { return scene.isCaster(object); });
}

IrradianceVolume volumeOf(const Scene& scene, const VolumeSettings& settings) {
  const Object& caster = casterOf(scene);
  return {scene.meshOf(caster),
          materialInOwnSpace(scene.materialOf(caster), caster.placement.scale),
          settings,
          {}};
}

SensorLayer readVolume(const Scene& scene, IrradianceVolume& volume, LightInterpolation interpolation,
                       uint32_t pointsAcross) {
  const Sensor& sensor = scene.sensors[0];
  const Placement& placement = casterOf(scene).placement;
  const vec3 light = placement.inverseDirection(scene.lights[0].direction);
  const vec3 normal = placement.inverseDirection(sensor.normal());
  const uint32_t points = pointsAcross * pointsAcross;
  SensorLayer layer;
  for (uint32_t y = 0; y < sensor.resolution.y; ++y)
    for (uint32_t x = 0; x < sensor.resolution.x; ++x) {
      vec3 sum(0);
      for (uint32_t i = 0; i < points; ++i) {
        const vec2 within =
            (vec2(float(i % pointsAcross), float(i / pointsAcross)) + 0.5f) / float(pointsAcross);
        const vec2 place = (vec2(float(x), float(y)) + within) / vec2(sensor.resolution);
        const vec3 point = sensor.corner + place.x * sensor.u + place.y * sensor.v;
        sum += volume.illuminance(placement.inversePoint(point), normal, light, interpolation);
      }
      layer.push_back(scene.lights[0].illuminance * sum / float(points));
    }
  return layer;
}

SensorLayer readReference(const Scene& scene, uint32_t passes) {
  const RayScene rays(scene);
  ReferenceSettings settings;
  settings.paths = Paths::transmission;
  settings.spectrum = Spectrum::channels;
  ReferenceSensor sensor(scene, rays, scene.sensors[0], settings);
  for (uint32_t pass = 0; pass < passes; ++pass) sensor.pass();
  const Image image = sensor.image();
  SensorLayer layer(image.pixelCount());
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>& values = *image.find(std::string("caustics.") + "RGB"[c]);
    for (std::size_t i = 0; i < layer.size(); ++i) layer[i][c] = values[i];
  }
  return layer;
}

SensorLayer readBeams(const Scene& scene, Progress& progress) {
  constexpr uint32_t kRefineDepth = 3;
  const RayScene rays(scene);
  const TracedSource traced(scene, rays);
  Stats stats;
  return measureBeams(scene, rays, traced, scene.sensors[0], Paths::transmission, kRefineDepth, progress,
                      stats);
}

double meanOf(const SensorLayer& layer) {
  double sum = 0;
  for (const vec3& lux : layer) sum += double(lux.x + lux.y + lux.z) / 3;
  return sum / double(layer.size());
}

double rootMeanSquare(const SensorLayer& a, const SensorLayer& b) {
  double squares = 0;
  for (std::size_t i = 0; i < a.size(); ++i) squares += double(dot(a[i] - b[i], a[i] - b[i])) / 3;
  return std::sqrt(squares / double(a.size()));
}

}  // namespace nephroid
