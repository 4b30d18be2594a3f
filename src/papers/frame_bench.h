// How long frames take.
#pragma once

#include <functional>
#include <optional>

#include "papers/paper_tables.h"
#include "render/frame.h"

namespace nephroid {

// The device that frames are timed on, where there is one, and what a table's title says of it.
struct BenchDevice {
  explicit BenchDevice(const PaperBench& bench);
  gpu::Device* orNone() { return device ? &*device : nullptr; }

  std::optional<gpu::Device> device;
  std::string on;  // "on NAME", "without frame rates: WHY"
};

// A scene's technique and what draws its frames.
class FrameBench {
 public:
  // Device and progress outlive it.
  FrameBench(gpu::Device& device, const Scene& scene, const TechniqueSettings& settings,
             const RenderSettings& render, Progress& progress);

  // The median seconds of `frames` frames, after `warmUps`, which make images and programs.
  struct Counts {
    int warmUps, frames;
  };
  double seconds(Counts counts, const std::function<Scene(int)>& sceneOfFrame);
  double seconds(Counts counts, const Scene& still);

  // The median over the same frames; 0 where there was no such pass.
  double passMilliseconds(const std::string& pass) const;

  const Stats& stats() const { return stats_; }  // of the last frame
  Technique& technique() { return *technique_; }
  Renderer& renderer() { return renderer_; }

 private:
  Stats stats_;
  SceneTransport transport_;
  std::unique_ptr<Technique> technique_;
  Renderer renderer_;
  std::vector<std::vector<PassTime>> passes_;  // of each timed frame
};

}  // namespace nephroid
