#include <chrono>
#include <memory>

#include "command.h"
#include "core/error.h"
#include "core/image_io.h"
#include "render/measure.h"
#include "scene/load.h"
#include "techniques/sources.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

struct MeasureOptions : CommonOptions {
  std::string sensor;
  TechniqueSettings technique;
};

const Sensor& sensorNamed(const Scene& scene, const std::string& name) {
  std::vector<std::string> names;
  for (const Sensor& sensor : scene.sensors) {
    if (sensor.name == name) return sensor;
    names.push_back(sensor.name);
  }
  const std::string nearest = nearestName(name, names);
  throw InputError("'" + scene.file.string() + "' has no sensor '" + name + "'" +
                   (names.empty()     ? "; it has none at all, add a [[sensor]]"
                    : nearest.empty() ? "; it has: " + joined(names)
                                      : "; did you mean '" + nearest + "'?"));
}

void runMeasure(const MeasureOptions& options) {
  checkOutput(options.output, options.scene, {".exr"});
  if (!options.stats.empty()) checkOutput(options.stats, options.scene);
  const TechniqueSettings& settings = options.technique;
  Progress progress(progressDisplay(options.isQuiet));
  Stats stats;
  stats.technique = settings.technique;
  stats.source = nameOf(settings.source);

  const Stopwatch preparing;
  const Scene scene = loadScene(options.scene, options.time);
  const Sensor& sensor = sensorNamed(scene, options.sensor);
  const RayScene rays(scene);
  const TracedSource traced(scene, rays);
  std::unique_ptr<TransportSource> table;
  if (settings.source == Source::table) table = makeTableSource(scene, settings, traced, progress);
  const TransportSource& source = table ? *table : static_cast<const TransportSource&>(traced);
  stats.prepareMilliseconds = preparing.milliseconds();

  SensorLayer direct, caustics;
  std::vector<double> times;
  for (uint32_t i = 0; i < options.repeat; ++i) {
    stats.counts.clear();
    const Stopwatch frame;
    direct = measureDirect(scene, rays, sensor, progress);
    caustics =
        measureBeams(scene, rays, source, sensor, settings.paths, settings.refineDepth, progress, stats);
    times.push_back(frame.milliseconds());
  }
  stats.frameMilliseconds = median(times);

  writeExr(options.output, sensorImage(scene, sensor, direct, caustics), imageAttributes(settings, "lux"));
  writeStats(options.stats, stats);
}

}  // namespace

Command addMeasure(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("measure", "What an illuminance meter in the scene reads, in lux, as an EXR");
  const auto options = std::make_shared<MeasureOptions>();
  addScene(*command, options->scene);
  command->add_option("--sensor", options->sensor, "The name of a [[sensor]] of the scene")
      ->required()
      ->type_name("NAME");
  addOutput(*command, options->output,
            "The EXR to write, 32-bit float, in lux: R,G,B the total; direct.R,G,B light that met no caster; "
            "caustics.R,G,B light that met at least one");
  addTime(*command, options->time);
  addTechnique(*command, options->technique, true);
  addMeasuring(*command, *options);
  addQuiet(*command, options->isQuiet);
  return {command, [options] { runMeasure(*options); }};
}

}  // namespace nephroid
