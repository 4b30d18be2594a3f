#include <algorithm>
#include <iostream>
#include <memory>

#include "command.h"
#include "core/error.h"
#include "drawing.h"
#include "formats/load.h"
#include "reference/image.h"
#include "reference/sensor.h"
#include "refining.h"
#include "render/metering.h"
#include "render/omissions.h"
#include "render/technique_meter.h"
#include "report/report_folder.h"
#include "report/seen_directly.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

struct CompareOptions : CommonOptions {
  std::vector<std::string> techniques;
  PictureSettings picture;
  ToneChoice tone;
  uvec2 size{640, 480};  // pixels
  ReferenceOptions reference;
};

// Everything that what is compared is made from.
struct CompareJob {
  const CompareOptions& options;
  const Scene& scene;
  const RayScene& rays;
  gpu::Device& device;
  Progress& progress;
};

PictureSettings settingsOf(const CompareOptions& options, const std::string& technique) {
  PictureSettings settings = options.picture;
  settings.technique.technique = technique;
  return settings;
}

Stats statsOf(const PictureSettings& settings, const gpu::Device& device) {
  Stats stats;
  stats.device = device.info().name;
  describeSettings(settings, stats);
  return stats;
}

TechniqueResult drawTechnique(const CompareJob& job, const std::string& technique) {
  const PictureSettings settings = settingsOf(job.options, technique);
  TechniqueResult result{{}, statsOf(settings, job.device), imageAttributes(settings, "nit")};
  // Techniques are timed by frames of one sample, as a window draws them while something moves.
  PictureSettings timed = settings;
  timed.samples.count = 1;
  const ToneChoice unmetered{.isExposureChosen = true, .exposure = 1.0f, .tone = {}};
  const FrameRequest request{job.options.scene, job.options.time,   timed,    unmetered,
                             job.options.size,  job.options.repeat, technique};
  const uint32_t samples = settings.samples.count;
  const auto draw = [&](Renderer& renderer) {
    while (samples > 1 && renderer.gathered() < samples) renderer.gather(samples);
    result.image = renderer.layers();
  };
  addMedianFrame(drawFrame(request, job.device, job.progress, result.stats, draw), result.stats);
  return result;
}

TechniqueResult readTechnique(const CompareJob& job, const std::string& technique, const Sensor& sensor,
                              const SensorLayer& direct) {
  const PictureSettings settings = settingsOf(job.options, technique);
  TechniqueResult result{{}, statsOf(settings, job.device), imageAttributes(settings, "lux")};
  const Stopwatch preparing;
  const TechniqueInfo& info = techniqueNamed(technique);
  std::optional<TechniqueMeter> meter;
  if (!info.measure)
    meter.emplace(job.device, job.scene, sensor, settings.technique, job.progress, result.stats);
  result.stats.prepareMilliseconds = preparing.milliseconds();
  const auto read = [&] {
    return meter
               ? meter->read()
               : info.measure({job.scene, job.rays, sensor, settings.technique}, job.progress, result.stats);
  };
  const SensorLayer caustics = readRepeatedly(read, job.options.repeat, result.stats);
  result.stats.memoryBytes = job.device.memoryBytes();
  result.image = sensorImage(job.scene, sensor, direct, caustics);
  return result;
}

ReferenceResult refineReference(const CompareJob& job, Estimate& estimate, const ReferenceSettings& settings,
                                const std::string& sensor) {
  const CompareOptions& options = job.options;
  const Stopwatch watch;
  const StopRule stop = stopRule(options.reference, options.picture);
  if (!refine(estimate, stop, job.progress)) throw Interrupted();
  const ReferenceJob written{
      options, options.reference, settings, stop, job.scene, sensor.empty() ? "nit" : "lux", sensor};
  return {estimate.image(), estimate.passes(), estimate.noise(), watch.milliseconds() / 1000,
          referenceAttributes(estimate, written)};
}

// Draws the camera's picture by each of `techniques`, and takes those out that cannot draw it here: with all
// paths, some need more memory than there is. Throws where none is left.
std::vector<TechniqueResult> drawTechniques(const CompareJob& job, std::vector<std::string>& techniques) {
  std::vector<TechniqueResult> results;
  std::vector<std::string> drawn;
  for (const std::string& technique : techniques) {
    try {
      results.push_back(drawTechnique(job, technique));
      drawn.push_back(technique);
    } catch (const RuntimeFailure& failure) {
      if (techniques.size() == 1) throw;
      std::cerr << "nephroid: warning: " << technique << " is left out: " << failure.what() << '\n';
    }
  }
  if (drawn.empty()) throw RuntimeFailure("no technique could draw the scene");
  techniques = drawn;
  return results;
}

SideBySide compareView(const CompareJob& job, std::vector<TechniqueResult> drawn) {
  SideBySide view;
  view.techniques = std::move(drawn);
  view.seesReceiver = seesReceiver(job.scene, job.rays, job.options.size);
  const ReferenceSettings settings =
      referenceSettings(job.options.reference, job.options.picture, job.options.size);
  ReferenceImage reference(job.scene, job.rays, settings);
  view.reference = refineReference(job, reference, settings, "");
  return view;
}

SideBySide compareSensor(const CompareJob& job, const Sensor& sensor) {
  SideBySide side;
  side.sensor = sensor.name;
  const SensorLayer direct = measureDirect(job.scene, job.rays, sensor,
                                           accuracyOf(job.options.picture.technique).error, job.progress);
  for (const std::string& technique : job.options.techniques)
    side.techniques.push_back(readTechnique(job, technique, sensor, direct));
  const ReferenceSettings settings =
      referenceSettings(job.options.reference, job.options.picture, sensor.resolution);
  ReferenceSensor reference(job.scene, job.rays, sensor, settings);
  side.reference = refineReference(job, reference, settings, sensor.name);
  return side;
}

std::vector<LeftOut> leftOutOf(const CompareOptions& options, const Scene& scene) {
  std::vector<LeftOut> all;
  const auto add = [&](const std::string& technique, std::span<const Omission> omissions) {
    for (const Omission& omission : omissions)
      all.push_back({technique, omission.what, omission.concerns(scene)});
  };
  add("", omissionsOfFrame());
  for (const TechniqueInfo* info : techniques())
    if (std::count(options.techniques.begin(), options.techniques.end(), info->name) > 0)
      add(info->name, info->omissions);
  return all;
}

// All pictures of a comparison have the exposure of the reference's.
void showAlike(Comparison& comparison, const Camera& camera) {
  SideBySide& view = comparison.view;
  comparison.toneMapping = toneMappingOf(camera, view.reference.image);
  addToneAttributes(comparison.toneMapping, view.reference.attributes);
  for (TechniqueResult& technique : view.techniques)
    addToneAttributes(comparison.toneMapping, technique.attributes);
}

void runCompare(CompareOptions options) {
  checkReportFolder(options.output);
  Progress progress(progressDisplay(options.isQuiet));
  Scene scene = loadScene(options.scene, options.time);
  applyTo(scene.camera, options.tone);
  Stats told;
  warnOf(scene, told);
  gpu::Device device({.device = options.device});
  const RayScene rays(scene);
  const CompareJob job{options, scene, rays, device, progress};

  Comparison comparison;
  comparison.program = "nephroid " NEPHROID_VERSION;
  comparison.scene = options.scene.filename().string();
  comparison.commandLine = commandLine();
  comparison.device = device.info().name;
  comparison.time = options.time;
  const ReferenceSettings reference = referenceSettings(options.reference, options.picture, options.size);
  comparison.paths = nameOf(reference.paths);
  comparison.techniquePaths = nameOf(options.picture.technique.transport.paths);
  comparison.spectrum = reference.spectrum == Spectrum::channels ? "channels" : "continuous";
  comparison.photons = reference.photons;
  std::vector<TechniqueResult> drawn = drawTechniques(job, options.techniques);
  comparison.leftOut = leftOutOf(options, scene);
  comparison.view = compareView(job, std::move(drawn));
  showAlike(comparison, scene.camera);
  for (const Sensor& sensor : scene.sensors) comparison.sensors.push_back(compareSensor(job, sensor));
  writeReport(options.output, comparison);
}

std::vector<std::string> comparedTechniques() {
  std::vector<std::string> names;
  for (const TechniqueInfo* info : techniques()) names.emplace_back(info->name);
  return names;
}

void addTechniques(CLI::App& command, std::vector<std::string>& chosen) {
  const std::vector<std::string> names = comparedTechniques();
  chosen = names;
  command
      .add_option(
          "--techniques", chosen,
          "The techniques to compare, separated by commas: " + joined(names) + ". Without it: all of them")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(oneOf(names))
      ->type_name("NAME,...")
      ->group("Technique");
}

// Names given twice are compared once, in the order of the registry.
std::vector<std::string> inOrder(const std::vector<std::string>& chosen) {
  std::vector<std::string> names;
  for (const std::string& name : comparedTechniques())
    if (std::find(chosen.begin(), chosen.end(), name) != chosen.end()) names.push_back(name);
  return names;
}

}  // namespace

Command addCompare(CLI::App& program) {
  CLI::App* command = program.add_subcommand(
      "compare", "Compares techniques with the reference: writes a page with their images, errors and times");
  const auto options = std::make_shared<CompareOptions>();
  addScene(*command, options->scene);
  command
      ->add_option(
          "-o,--output", options->output,
          "The folder to write: index.html, which opens from disk; report.json; every image as EXR and PNG. "
          "An existing report is replaced")
      ->required()
      ->type_name("REPORT_DIR");
  addSize(*command, options->size);
  addTime(*command, options->time);
  addTone(*command, options->tone);
  addTechniques(*command, options->techniques);
  addPictureSettings(*command, options->picture);
  addReference(*command, options->reference);
  addDevice(*command, options->device);
  addRepeat(*command, options->repeat);
  addQuiet(*command, options->isQuiet);
  return {command, [options] {
            options->techniques = inOrder(options->techniques);
            runCompare(*options);
          }};
}

}  // namespace nephroid
