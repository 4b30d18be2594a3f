// Draws frames and reads sensors for the commands: repeated as often as asked for, and timed.
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
  const ToneChoice& tone;
  uvec2 size{640, 480};  // pixels
  uint32_t repeat = 1;
  std::string name;           // of this step, shown at the progress bar
  WaveRuns* waves = nullptr;  // the state of simulated water after the frame before; null: none
};

struct FrameTime {
  double milliseconds = 0;
  std::vector<PassTime> passes;
};

// Loads the scene and draws it `repeat` times. Then calls `use` with the renderer, which holds the last
// frame. Returns the times of all repetitions; sets all other figures in `stats`.
std::vector<FrameTime> drawFrame(const FrameRequest& request, gpu::Device& device, Progress& progress,
                                 Stats& stats, const std::function<void(Renderer&)>& use);

// Writes the time of the median frame, and the times of its passes, to `stats`.
void addMedianFrame(std::vector<FrameTime> times, Stats& stats);

// Reads a sensor `repeat` times. Writes the median of the times, and the counts of the last reading, to
// `stats`.
SensorLayer readRepeatedly(const std::function<SensorLayer()>& read, uint32_t repeat, Stats& stats);

}  // namespace nephroid
