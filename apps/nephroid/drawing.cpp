#include "drawing.h"

#include <algorithm>

#include "beams/source_error.h"
#include "command.h"
#include "formats/load.h"
#include "report/missing_light.h"
#include "techniques/registry.h"

namespace nephroid {

std::vector<FrameTime> drawFrame(const FrameRequest& request, gpu::Device& device, Progress& progress,
                                 Stats& stats, const std::function<void(Renderer&)>& use) {
  const Stopwatch preparing;
  Scene scene = loadScene(request.scene, request.time, request.waves);
  applyTo(scene.camera, request.tone);
  SceneTransport transport(scene, transportOf(request.settings.technique), progress);
  const auto technique = makeTechnique({device, request.settings.technique, transport, stats});
  Renderer renderer(device, transport, renderSettings(request.settings, request.size), *technique);
  stats.prepareMilliseconds += preparing.milliseconds();

  std::vector<FrameTime> times(request.repeat);
  progress.begin(request.name, request.repeat);
  for (FrameTime& time : times) {
    const Stopwatch frame;
    time.passes = renderer.render(scene);
    time.milliseconds = frame.milliseconds();
    scene.camera.exposure = renderer.exposure();  // metered once
    progress.advance();
  }
  progress.finish();
  if (techniqueNamed(request.settings.technique.technique).traits.drawsCaustics)
    stats.notes = missingLight(scene, stats.budget);
  const TransportSettings transported = transportOf(request.settings.technique);
  if (transported.source == Source::table)
    if (const auto note = sourceErrorNote(transport.scene(), transport.rayScene(), transport.source(),
                                          transport.traced(), request.settings.technique.transport.paths))
      addLine(stats.notes, *note);
  stats.memoryBytes = std::max(stats.memoryBytes, device.memoryBytes());
  stats.exposure = double(renderer.exposure());
  renderer.tellSight(stats);
  use(renderer);
  return times;
}

void addMedianFrame(std::vector<FrameTime> times, Stats& stats) {
  std::sort(times.begin(), times.end(),
            [](const FrameTime& a, const FrameTime& b) { return a.milliseconds < b.milliseconds; });
  const FrameTime& middle = times[times.size() / 2];
  stats.frameMilliseconds = middle.milliseconds;
  stats.passes = middle.passes;
}

SensorLayer readRepeatedly(const std::function<SensorLayer()>& read, uint32_t repeat, Stats& stats) {
  SensorLayer layer;
  std::vector<double> times;
  for (uint32_t i = 0; i < repeat; ++i) {
    stats.counts.clear();
    const Stopwatch frame;
    layer = read();
    times.push_back(frame.milliseconds());
  }
  stats.frameMilliseconds = median(times);
  return layer;
}

}  // namespace nephroid
