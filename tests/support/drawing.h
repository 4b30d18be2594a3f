// What a technique makes of a scene.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/frame.h"
#include "render/technique_meter.h"
#include "techniques/registry.h"

namespace nephroid {

inline TechniqueSettings settingsOf(const std::string& technique, Source source = Source::traced) {
  TechniqueSettings settings;
  settings.technique = technique;
  settings.transport.source = source;
  settings.transport.paths = Paths::transmission;
  return settings;
}

// A technique and what draws its frames.
struct Drawing {
  Drawing(gpu::Device& device, const Scene& scene, TechniqueSettings chosen, const RenderSettings& frame,
          SceneTransport::SourceMaker maker = {})
      : settings(std::move(chosen)),
        transport(scene, transportOf(settings), progress, std::move(maker)),
        technique(makeTechnique({device, settings, transport, stats})),
        renderer(device, transport, frame, *technique) {}
  Drawing(const Drawing&) = delete;
  Drawing& operator=(const Drawing&) = delete;

  Image layers(const Scene& scene) {
    renderer.render(scene);
    return renderer.layers();
  }

  TechniqueSettings settings;
  Progress progress;
  Stats stats;
  SceneTransport transport;
  std::unique_ptr<Technique> technique;
  Renderer renderer;
};

// lux, by texel of the sensor
inline SensorLayer measuredBy(gpu::Device& device, const Scene& scene, const Sensor& sensor,
                              const TechniqueSettings& settings) {
  Progress progress;
  Stats stats;
  return TechniqueMeter(device, scene, sensor, settings, progress, stats).read();
}

}  // namespace nephroid
