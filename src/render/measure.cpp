#include "render/measure.h"

#include <oneapi/tbb/parallel_for.h>

#include "beams/build.h"
#include "beams/deposit.h"
#include "lights/emitters.h"
#include "lights/lamp_light.h"
#include "lights/light_in_air.h"
#include "lights/light_intensity.h"
#include "render/lamp_exposure.h"
#include "scene/checks.h"
#include "transport/queries.h"

namespace nephroid {
namespace {

constexpr uint32_t kShadowGrid = 4;  // points along a texel's side that look at each light

vec3 directAt(const Scene& scene, const RayScene& rays, const std::vector<ShapedLight>& lights,
              const std::vector<Emitter>& emitters, vec3 point, vec3 normal) {
  vec3 sum(0);
  for (const Emitter& emitter : emitters) {
    const vec3 direction = emitterDirection(emitter, point);
    const float cosine = -dot(direction, normal);
    if (cosine <= 0) continue;
    const float distance = emitter.type == kEmitterDirectional ? std::numeric_limits<float>::infinity()
                                                               : length(emitter.position - point);
    if (!rays.occluded(rays.fromMeter(point, -direction, cosine, distance)))
      sum += cosine * airTransmittance(scene, emitter, point) *
             illuminance(lights[emitter.light], emitter, point);
  }
  return sum;
}

void addChannels(Image& image, const std::string& prefix, const SensorLayer& layer) {
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& values = image.channel(prefix + "RGB"[c]);
    for (std::size_t i = 0; i < layer.size(); ++i) values[i] += layer[i][c];
  }
}

}  // namespace

SensorLayer measureDirect(const Scene& scene, const RayScene& rays, const Sensor& sensor, float error,
                          Progress& progress) {
  checkSensor(sensor);
  std::vector<Emitter> emitters;  // of lights without a size, and parts of skies
  for (uint32_t i = 0; i < scene.lights.size(); ++i)
    if (!hasSize(scene.lights[i])) {
      const std::vector<Emitter> own = emittersOf(scene.lights[i], i);
      emitters.insert(emitters.end(), own.begin(), own.end());
    }
  const LampExposure lamps(scene, rays, sensor, error);
  const std::vector<ShapedLight> lights = shapedLights(scene);
  const vec3 normal = sensor.normal();
  SensorLayer layer(std::size_t(sensor.resolution.x) * sensor.resolution.y, vec3(0));
  progress.begin("direct light", sensor.resolution.y);
  oneapi::tbb::parallel_for(0u, sensor.resolution.y, [&](uint32_t row) {
    for (uint32_t column = 0; column < sensor.resolution.x; ++column) {
      vec3 sum(0);
      for (uint32_t i = 0; i < kShadowGrid * kShadowGrid; ++i) {
        const vec2 at =
            vec2(float(i % kShadowGrid) + 0.5f, float(i / kShadowGrid) + 0.5f) / float(kShadowGrid);
        const vec3 point = sensor.corner + sensor.u * ((float(column) + at.x) / float(sensor.resolution.x)) +
                           sensor.v * ((float(row) + at.y) / float(sensor.resolution.y));
        sum += directAt(scene, rays, lights, emitters, point, normal);
      }
      layer[std::size_t(row) * sensor.resolution.x + column] =
          sum / float(kShadowGrid * kShadowGrid) + lamps.onTexel({column, row});
    }
    progress.advance();
  });
  progress.finish();
  return layer;
}

SensorLayer measureBeams(const Scene& scene, const RayScene& rays, const TransportSource& source,
                         const Sensor& sensor, Paths paths, uint32_t refineDepth, Progress& progress,
                         Stats& stats) {
  checkSensor(sensor);
  const TracedSource media(scene, rays);
  const PlaneGrid grid = gridOf(sensor);
  BeamSettings settings;
  settings.refineDepth = refineDepth;
  settings.targets = {{grid}};
  settings.stopAtSurfaces = true;

  std::vector<BandQuery> queries;
  for (const Emitter& emitter : emittersOf(scene))
    for (uint32_t object = 0; object < scene.objects.size(); ++object)
      if (scene.isCaster(scene.objects[object]))
        for (BandQuery& query : queriesFor(scene, object, emitter, media.mediaAround(emitter), paths))
          queries.push_back(std::move(query));

  std::vector<glm::dvec3> flux(std::size_t(sensor.resolution.x) * sensor.resolution.y, glm::dvec3(0));
  uint64_t beams = 0, split = 0;
  progress.begin("beams", queries.size());
  for (const BandQuery& band : queries) {
    const BeamSet set = buildBeams(scene, source, band.query, band.bandColor, settings);
    const std::vector<glm::dvec3> part = depositFlux(set.beams, grid, sensor.resolution);
    for (std::size_t i = 0; i < flux.size(); ++i) flux[i] += part[i];
    beams += set.beams.size();
    split += set.split;
    progress.advance();
  }
  progress.finish();
  stats.counts.emplace_back("beams", beams);
  stats.counts.emplace_back("split_beams", split);

  const double texelArea = double(length(cross(sensor.v, sensor.u))) / double(flux.size());  // m2
  SensorLayer layer(flux.size());
  for (std::size_t i = 0; i < flux.size(); ++i) layer[i] = vec3(flux[i] / texelArea);
  return layer;
}

Image sensorImage(const Scene& scene, const Sensor& sensor, const SensorLayer& direct,
                  const SensorLayer& caustics) {
  Image image;
  image.width = sensor.resolution.x;
  image.height = sensor.resolution.y;
  const SensorLayer ambient(direct.size(), scene.environment.ambient);
  for (const SensorLayer* layer : {&direct, &caustics, &ambient}) addChannels(image, "", *layer);
  addChannels(image, "direct.", direct);
  addChannels(image, "caustics.", caustics);
  addChannels(image, "ambient.", ambient);
  return image;
}

}  // namespace nephroid
