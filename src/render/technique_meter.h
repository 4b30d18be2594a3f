// Measures what a technique gives on a sensor.
#pragma once

#include <memory>
#include <vector>

#include "gpu/resources.h"
#include "gpu_scene/gpu_scene.h"
#include "render/measure.h"
#include "techniques/registry.h"

namespace nephroid {

// Reads a sensor with a technique, as if a receiver stood in the sensor's place and a camera saw it. So it
// has all errors of the technique.
class TechniqueMeter {
 public:
  // Device, sensor, settings, progress and stats must outlive it.
  TechniqueMeter(gpu::Device& device, const Scene& scene, const Sensor& sensor,
                 const TechniqueSettings& settings, Progress& progress, Stats& stats);

  // The illuminance (lux) by light that met a caster. Each call does all work that a moved light needs.
  SensorLayer read();

 private:
  void uploadNormals();
  void uploadPoints(vec2 offset);  // `offset`: place of the points in their part of a texel
  void addShaded(SensorLayer& layer);

  gpu::Device& device_;
  const Sensor& sensor_;
  Scene scene_;  // with a receiver where the sensor is
  GpuScene gpuScene_;
  SceneTransport transport_;
  std::unique_ptr<Technique> technique_;
  gpu::Image positions_, normals_, caustics_;
};

}  // namespace nephroid
