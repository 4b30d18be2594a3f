// Frames and sensors as commands make them: as often as asked for, with their times.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "render/frame.h"
#include "render/measure.h"
#include "water/wave_simulation.h"

namespace nephroid {

struct FrameRequest {
  const std::filesystem::path& scene;
  double time = 0;  // s
  const PictureSettings& settings;
  uvec2 size{640, 480};  // pixels
  uint32_t repeat = 1;
  std::string name;           // of the step, for the progress bar
  WaveRuns* waves = nullptr;  // of the frame before
};

struct FrameTime {
  double milliseconds = 0;
  std::vector<PassTime> passes;
};

// Loads the scene and draws it; `use` is given the last frame. Returns the times of all repetitions; the rest
// goes to `stats`.
std::vector<FrameTime> drawFrame(const FrameRequest& request, gpu::Device& device, Progress& progress,
                                 Stats& stats, const std::function<void(Renderer&)>& use);

// The median's time, and that of its passes.
void addMedianFrame(std::vector<FrameTime> times, Stats& stats);

// Reads a sensor `repeat` times; the median of the times goes to `stats`, with the counts of the last.
SensorLayer readRepeatedly(const std::function<SensorLayer()>& read, uint32_t repeat, Stats& stats);

}  // namespace nephroid
