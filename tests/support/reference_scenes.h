// Scenes put together in a few lines, for tests of the reference renderer.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "geometry/shapes.h"
#include "reference/image.h"
#include "reference/sensor.h"
#include "support/photons.h"
#include "support/statistics.h"

namespace nephroid {

inline Material glass(float ior = 1.5f) {
  Material material;
  material.type = MaterialType::dielectric;
  material.color = vec3(1);
  material.ior = vec3(ior);
  return material;
}

inline Material mirror(float reflectance = 1) {
  Material material;
  material.type = MaterialType::mirror;
  material.color = vec3(reflectance);
  return material;
}

inline Material diffuse(float reflectance) {
  Material material;
  material.color = vec3(reflectance);
  return material;
}

// The object, until another is added.
inline Object& add(Scene& scene, Mesh mesh, const Material& material, vec3 translation = vec3(0)) {
  Object object;
  object.mesh = uint32_t(scene.meshes.size());
  object.material = uint32_t(scene.materials.size());
  object.placement.translation = translation;
  scene.meshes.push_back(std::move(mesh));
  scene.materials.push_back(material);
  scene.objects.push_back(object);
  return scene.objects.back();
}

inline Light pointLight(vec3 position, float candela = 100) {
  Light light;
  light.position = position;
  light.intensity = vec3(candela);
  return light;
}

inline Light sun(vec3 direction, float lux = 1000) {
  Light light;
  light.type = LightType::directional;
  light.direction = normalize(direction);
  light.illuminance = vec3(lux);
  return light;
}

inline Light spotLight(vec3 position, vec3 target, float innerAngle, float outerAngle, float candela = 100) {
  Light light = pointLight(position, candela);
  light.type = LightType::spot;
  light.direction = normalize(target - position);
  light.innerAngle = innerAngle;
  light.outerAngle = outerAngle;
  return light;
}

inline Light lineLight(vec3 from, vec3 to, float candela = 100) {
  Light light = pointLight(from, candela);
  light.type = LightType::line;
  light.end = to;
  return light;
}

// Horizontal, facing up; texel (0, 0) is at the lowest x and z.
inline Sensor floorSensor(vec3 center, float halfSize, uint32_t resolution) {
  return {"floor",
          center - vec3(halfSize, 0, halfSize),
          {2 * halfSize, 0, 0},
          {0, 0, 2 * halfSize},
          uvec2(resolution)};
}

inline void runPasses(Estimate& estimate, uint32_t passes) {
  for (uint32_t i = 0; i < passes; ++i) estimate.pass();
}

inline Image measured(const Scene& scene, const Sensor& sensor, uint32_t passes,
                      const ReferenceSettings& settings) {
  const RayScene rays(scene);
  ReferenceSensor meter(scene, rays, sensor, settings);
  runPasses(meter, passes);
  return meter.image();
}

inline Image seen(const Scene& scene, uint32_t passes, const ReferenceSettings& settings) {
  const RayScene rays(scene);
  ReferenceImage image(scene, rays, settings);
  runPasses(image, passes);
  return image.image();
}

// For each channel, the means over square blocks of `blockSize` pixels, in rows, of what each of so many
// passes sees by itself: pixels of a pass share photons, passes share nothing.
inline std::vector<std::vector<SampleMean>> blockMeans(Estimate& estimate,
                                                       const std::vector<std::string>& channels,
                                                       uint32_t passes, uint32_t blockSize) {
  std::vector<std::vector<SampleMean>> means(channels.size());
  std::vector<std::vector<double>> before(channels.size());
  for (uint32_t pass = 1; pass <= passes; ++pass) {
    estimate.pass();
    const Image image = estimate.image();
    const uint32_t across = image.width / blockSize;
    for (std::size_t c = 0; c < channels.size(); ++c) {
      const std::vector<float>& values = *image.find(channels[c]);
      std::vector<double> sums(std::size_t(across) * (image.height / blockSize), 0.0);
      for (std::size_t i = 0; i < values.size(); ++i)
        sums.at(i / image.width / blockSize * across + i % image.width / blockSize) +=
            double(values[i]) * pass / (blockSize * blockSize);
      means[c].resize(sums.size());
      before[c].resize(sums.size());
      for (std::size_t block = 0; block < sums.size(); ++block)
        means[c][block].add(sums[block] - before[c][block]);
      before[c] = sums;
    }
  }
  return means;
}

}  // namespace nephroid
