#include "papers/frame_bench.h"

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

FrameBench::FrameBench(gpu::Device& device, const Scene& scene, const TechniqueSettings& settings,
                       const RenderSettings& render, Progress& progress)
    : transport_(scene, transportOf(settings), progress),
      technique_(makeTechnique({device, settings, transport_, stats_})),
      renderer_(device, transport_, render, *technique_) {}

double FrameBench::seconds(Counts counts, const std::function<Scene(int)>& sceneOfFrame) {
  passes_.clear();
  std::vector<double> seconds;
  for (int frame = 0; frame < counts.warmUps + counts.frames; ++frame) {
    const Scene scene = sceneOfFrame(frame);
    const Stopwatch watch;
    std::vector<PassTime> passes = renderer_.render(scene);
    const double taken = watch.seconds();
    if (frame < counts.warmUps) continue;
    seconds.push_back(taken);
    passes_.push_back(std::move(passes));
  }
  return median(seconds);
}

double FrameBench::seconds(Counts counts, const Scene& still) {
  return seconds(counts, [&](int) { return still; });
}

double FrameBench::passMilliseconds(const std::string& name) const {
  std::vector<double> each;
  for (const std::vector<PassTime>& passes : passes_) {
    double sum = 0;
    for (const PassTime& pass : passes)
      if (pass.name == name) sum += pass.milliseconds;
    each.push_back(sum);
  }
  return median(each);
}

}  // namespace nephroid
