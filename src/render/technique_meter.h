#pragma once

#include <memory>
#include <vector>

#include "gpu/resources.h"
#include "gpu_scene/gpu_scene.h"
#include "render/measure.h"
#include "techniques/registry.h"

namespace nephroid {

// A sensor read through a technique, as a camera would see a receiver in its place: with all that virtual
// planes get wrong.
class TechniqueMeter {
 public:
  // Device, sensor, settings, progress and stats outlive it.
  TechniqueMeter(gpu::Device& device, const Scene& scene, const Sensor& sensor,
                 const TechniqueSettings& settings, Progress& progress, Stats& stats);

  // Illuminance (lux) by light that met a caster; recomputes all that a moved light would change.
  SensorLayer read();

 private:
  void uploadNormals();
  void uploadPoints(vec2 offset);  // where in its part of a texel each point lies
  void addShaded(SensorLayer& layer);

  gpu::Device& device;
  const Sensor& sensor;
  Scene scene;  // with a receiver where the sensor is
  GpuScene gpuScene;
  SceneTransport transport;
  std::unique_ptr<Technique> technique;
  gpu::Image positions, normals, caustics;
};

}  // namespace nephroid
