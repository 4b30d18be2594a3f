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

// A count that a technique told; kNoFigure where it told none of this name.
double countOf(const Stats& stats, const std::string& name);

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

  // One frame after the other, for several that take turns. `time` keeps the times, `warmUp` does not.
  void warmUp(const Scene& scene) { renderer_.render(scene); }
  void time(const Scene& scene);
  double seconds() const { return median(seconds_); }

  // The median time of these passes together in the timed frames; 0 where there was no such pass.
  double passMilliseconds(const std::vector<std::string>& passes) const;
  // That of the passes that make light, before receivers look it up. Techniques name them differently.
  double lightMilliseconds() const;

  const Stats& stats() const { return stats_; }  // of the last frame
  Technique& technique() { return *technique_; }
  Renderer& renderer() { return renderer_; }

 private:
  Stats stats_;
  SceneTransport transport_;
  std::unique_ptr<Technique> technique_;
  Renderer renderer_;
  // Of each timed frame.
  std::vector<double> seconds_;
  std::vector<std::vector<PassTime>> passes_;
};

}  // namespace nephroid
