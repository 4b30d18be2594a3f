#include <algorithm>
#include <functional>
#include <memory>
#include <optional>

#include "command.h"
#include "core/error.h"
#include "core/image_io.h"
#include "drawing.h"
#include "formats/load.h"
#include "reference/sensor.h"
#include "refining.h"
#include "render/technique_meter.h"
#include "report/missing_light.h"
#include "techniques/registry.h"
#include "transport/scene_transport.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

struct MeasureOptions : CommonOptions {
  std::string sensor;
  PictureSettings picture;
  ReferenceOptions reference;
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

// Reads the caustics again and again; what stays the same is made once.
using CausticsMeter = std::function<SensorLayer()>;

// By the beams alone, cut by the sensor's own plane. Needs no device.
CausticsMeter beamsMeter(const Scene& scene, const RayScene& rays, const Sensor& sensor,
                         const TechniqueSettings& settings, Progress& progress, Stats& stats) {
  const auto traced = std::make_shared<TracedSource>(scene, rays);
  std::shared_ptr<TransportSource> source = traced;
  const TransportSettings transport = transportOf(settings);
  if (transport.source == Source::table) {
    source = makeTableSource(scene, transport, *traced, progress);
    if (const auto note = sourceErrorNote(scene, rays, *source, *traced, settings.transport.paths))
      addLine(stats.notes, *note);
  }
  return [&, traced, source] {
    return measureBeams(scene, rays, *source, sensor, settings.transport.paths, settings.beams.refineDepth,
                        progress, stats);
  };
}

bool asksForSensorPlane(const TechniqueSettings& settings) {
  return std::ranges::any_of(techniques(), [&](const TechniqueInfo* info) {
    return info->isInSensorPlane && info->isInSensorPlane(settings);
  });
}

// Through the technique as it draws.
CausticsMeter techniqueMeter(gpu::Device& device, const Scene& scene, const Sensor& sensor,
                             const TechniqueSettings& settings, Progress& progress, Stats& stats) {
  const auto meter = std::make_shared<TechniqueMeter>(device, scene, sensor, settings, progress, stats);
  return [meter] { return meter->read(); };
}

void measureReference(const MeasureOptions& options) {
  Progress progress(progressDisplay(options.isQuiet));
  Stats stats;
  stats.technique = kReferenceName;
  stats.device = "host";
  const Stopwatch preparing;
  const Scene scene = loadScene(options.scene, options.time);
  const Sensor& sensor = sensorNamed(scene, options.sensor);
  warnOf(scene, stats);
  stats.notes = missingLight(scene, std::nullopt, &sensor);
  const RayScene rays(scene);
  const ReferenceSettings settings = referenceSettings(options.reference, options.picture, sensor.resolution);
  ReferenceSensor counter(scene, rays, sensor, settings);
  stats.prepareMilliseconds = preparing.milliseconds();
  const StopRule stop = stopRule(options.reference, options.picture);
  refineToFile(counter, {options, options.reference, settings, stop, scene, "lux", sensor.name}, progress,
               stats);
  reportStats(options.stats, stats);
}

void runMeasure(const MeasureOptions& options) {
  checkOutput(options.output, options.scene, {".exr"});
  if (!options.stats.empty()) checkOutput(options.stats, options.scene);
  if (isReference(options.picture)) return measureReference(options);
  const TechniqueSettings& settings = options.picture.technique;
  const TechniqueInfo& info = techniqueNamed(settings.technique);
  if (!info.isInSensorPlane && !info.measure && asksForSensorPlane(settings))
    throw InputError("--planes sensor: " + settings.technique +
                     " draws on no virtual planes across the light");
  if (info.measure && (!settings.baked.empty() || settings.transport.source == Source::table))
    throw InputError(
        settings.technique +
        " measures with rays of its own; for --source table or --baked name a technique that looks "
        "rays up, such as --technique illumination-textures");
  Progress progress(progressDisplay(options.isQuiet));
  Stats stats;
  describeSettings(options.picture, stats);

  const Stopwatch preparing;
  const Scene scene = loadScene(options.scene, options.time);
  const Sensor& sensor = sensorNamed(scene, options.sensor);
  warnOf(scene, stats);
  const RayScene rays(scene);
  std::optional<gpu::Device> device;
  CausticsMeter caustics;
  if (!info.traits.drawsCaustics) {
    stats.device = "host";
    caustics = [&] { return SensorLayer(std::size_t(sensor.resolution.x) * sensor.resolution.y, vec3(0)); };
  } else if (info.measure) {
    stats.device = "host";
    caustics = [&] { return info.measure({scene, rays, sensor, settings}, progress, stats); };
  } else if (info.isInSensorPlane && info.isInSensorPlane(settings)) {
    stats.device = "host";
    caustics = beamsMeter(scene, rays, sensor, settings, progress, stats);
  } else {
    device.emplace(gpu::DeviceOptions{.device = options.device});
    stats.device = device->info().name;
    caustics = techniqueMeter(*device, scene, sensor, settings, progress, stats);
  }
  stats.prepareMilliseconds = preparing.milliseconds();

  const SensorLayer causticsLayer = readRepeatedly(caustics, options.repeat, stats);
  if (device) stats.memoryBytes = device->memoryBytes();
  if (info.traits.drawsCaustics)
    for (const std::string& line : missingLight(scene, stats.budget, &sensor)) addLine(stats.notes, line);

  const SensorLayer direct = measureDirect(scene, rays, sensor, accuracyOf(settings).error, progress);
  writeExr(options.output, sensorImage(scene, sensor, direct, causticsLayer),
           imageAttributes(options.picture, "lux"));
  reportStats(options.stats, stats);
}

}  // namespace

Command addMeasure(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("measure", "Writes the illuminance on a sensor of the scene, in lux, as an EXR");
  const auto options = std::make_shared<MeasureOptions>();
  addScene(*command, options->scene);
  command->add_option("--sensor", options->sensor, "The name of a [[sensor]] of the scene")
      ->required()
      ->type_name("NAME");
  addOutput(*command, options->output,
            "The EXR to write, 32-bit float, in lux: R,G,B the total; direct.R,G,B light that met no caster; "
            "caustics.R,G,B light that met at least one");
  addTime(*command, options->time);
  addTechniqueOfSensor(*command, options->picture);
  addReference(*command, options->reference);
  addResume(*command, options->reference);
  addRepeat(*command, options->repeat);
  addStats(*command, options->stats);
  addQuiet(*command, options->isQuiet);
  return {command, [options] { runMeasure(*options); }};
}

}  // namespace nephroid
