// Measures frame times.
#pragma once

#include <functional>
#include <optional>

#include "papers/paper_tables.h"
#include "render/frame.h"

namespace nephroid {

// The device on which frames are timed, if there is one, and its description for a table's title.
struct BenchDevice {
  explicit BenchDevice(const PaperBench& bench);
  gpu::Device* orNone() { return device ? &*device : nullptr; }

  std::optional<gpu::Device> device;
  std::string on;  // "on NAME", "without frame rates: WHY"
};

// Draws frames of a scene with a technique, and times them.
class FrameBench {
 public:
  // Device and progress outlive it.
  FrameBench(gpu::Device& device, const Scene& scene, const TechniqueSettings& settings,
             const RenderSettings& render, Progress& progress);

  // Returns the median time (s) of `frames` frames. Before them, `warmUps` frames are drawn without timing,
  // which create images and programs.
  struct Counts {
    int warmUps, frames;
  };
  double seconds(Counts counts, const std::function<Scene(int)>& sceneOfFrame);
  double seconds(Counts counts, const Scene& still);

  // The median time of one pass in those frames; 0 where there was no such pass.
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
