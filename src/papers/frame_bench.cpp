#include "papers/frame_bench.h"

#include <algorithm>

#include "core/error.h"
#include "core/stopwatch.h"
#include "techniques/registry.h"

namespace nephroid {

BenchDevice::BenchDevice(const PaperBench& bench) {
  try {
    device.emplace(gpu::DeviceOptions{.device = bench.device});
    on = "on " + device->info().name;
  } catch (const RuntimeFailure& none) {
    on = std::string("without frame rates: ") + none.what();
  }
}

double countOf(const Stats& stats, const std::string& name) {
  const auto found = std::ranges::find(stats.counts, name, &std::pair<std::string, uint64_t>::first);
  return found == stats.counts.end() ? kNoFigure : double(found->second);
}

FrameBench::FrameBench(gpu::Device& device, const Scene& scene, const TechniqueSettings& settings,
                       const RenderSettings& render, Progress& progress)
    : transport_(scene, transportOf(settings), progress),
      technique_(makeTechnique({device, settings, transport_, stats_})),
      renderer_(device, transport_, render, *technique_) {}

void FrameBench::time(const Scene& scene) {
  const Stopwatch watch;
  passes_.push_back(renderer_.render(scene));
  seconds_.push_back(watch.seconds());
}

double FrameBench::seconds(Counts counts, const std::function<Scene(int)>& sceneOfFrame) {
  seconds_.clear();
  passes_.clear();
  for (int frame = 0; frame < counts.warmUps + counts.frames; ++frame) {
    const Scene scene = sceneOfFrame(frame);
    if (frame < counts.warmUps)
      warmUp(scene);
    else
      time(scene);
  }
  return seconds();
}

double FrameBench::seconds(Counts counts, const Scene& still) {
  return seconds(counts, [&](int) { return still; });
}

double FrameBench::passMilliseconds(const std::vector<std::string>& names) const {
  std::vector<double> each;
  for (const std::vector<PassTime>& passes : passes_) {
    double sum = 0;
    for (const PassTime& pass : passes)
      if (std::ranges::find(names, pass.name) != names.end()) sum += pass.milliseconds;
    each.push_back(sum);
  }
  return median(each);
}

double FrameBench::lightMilliseconds() const {
  return passMilliseconds({"beams", "landed light", "receivers from the light", "illumination textures",
                           "receivers across the view", "caustics maps", "light volumes"});
}

}  // namespace nephroid
