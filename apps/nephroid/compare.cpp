#include <algorithm>
#include <memory>

#include "command.h"
#include "core/error.h"
#include "drawing.h"
#include "formats/load.h"
#include "reference/image.h"
#include "reference/sensor.h"
#include "refining.h"
#include "render/technique_meter.h"
#include "report/report_folder.h"
#include "report/seen_directly.h"
#include "techniques/registry.h"

namespace nephroid {
namespace {

struct CompareOptions : CommonOptions {
  std::vector<std::string> techniques;
  TechniqueSettings technique;
  uvec2 size{640, 480};  // pixels
  ReferenceOptions reference;
};

// Everything that what is compared is made from.
struct Setting {
  const CompareOptions& options;
  const Scene& scene;
  const RayScene& rays;
  gpu::Device& device;
  Progress& progress;
};

TechniqueSettings settingsOf(const CompareOptions& options, const std::string& technique) {
  TechniqueSettings settings = options.technique;
  settings.technique = technique;
  return settings;
}

Stats statsOf(const TechniqueSettings& settings, const gpu::Device& device) {
  Stats stats;
  stats.device = device.info().name;
  stats.technique = settings.technique;
  stats.source = nameOf(settings.source);
  return stats;
}

TechniqueResult drawTechnique(const Setting& setting, const std::string& technique) {
  const TechniqueSettings settings = settingsOf(setting.options, technique);
  TechniqueResult result{{}, statsOf(settings, setting.device), imageAttributes(settings, "nit")};
  const FrameRequest request{setting.options.scene, setting.options.time,   settings,
                             setting.options.size,  setting.options.repeat, technique};
  addMedianFrame(drawFrame(request, setting.device, setting.progress, result.stats,
                           [&](Renderer& renderer) { result.image = renderer.layers(); }),
                 result.stats);
  return result;
}

TechniqueResult readTechnique(const Setting& setting, const std::string& technique, const Sensor& sensor,
                              const SensorLayer& direct) {
  const TechniqueSettings settings = settingsOf(setting.options, technique);
  TechniqueResult result{{}, statsOf(settings, setting.device), imageAttributes(settings, "lux")};
  const Stopwatch preparing;
  TechniqueMeter meter(setting.device, setting.scene, sensor, settings, setting.progress, result.stats);
  result.stats.prepareMilliseconds = preparing.milliseconds();
  const SensorLayer caustics =
      readRepeatedly([&] { return meter.read(); }, setting.options.repeat, result.stats);
  result.stats.memoryBytes = setting.device.memoryBytes();
  result.image = sensorImage(setting.scene, sensor, direct, caustics);
  return result;
}

ReferenceResult refineReference(const Setting& setting, Estimate& estimate, const ReferenceSettings& settings,
                                const std::string& sensor) {
  const CompareOptions& options = setting.options;
  const Stopwatch watch;
  if (!refine(estimate, stopRuleOf(options.reference), setting.progress)) throw Interrupted();
  const ReferenceJob job{options, options.reference, settings, setting.scene, sensor.empty() ? "nit" : "lux",
                         sensor};
  return {estimate.image(), estimate.passes(), estimate.noise(), watch.milliseconds() / 1000,
          referenceAttributes(estimate, job)};
}

SideBySide compareView(const Setting& setting) {
  SideBySide view;
  for (const std::string& technique : setting.options.techniques)
    view.techniques.push_back(drawTechnique(setting, technique));
  view.seesReceiver = seesReceiver(setting.scene, setting.rays, setting.options.size);
  const ReferenceSettings settings =
      referenceSettings(setting.options.reference, setting.options.technique, setting.options.size);
  ReferenceImage reference(setting.scene, setting.rays, settings);
  view.reference = refineReference(setting, reference, settings, "");
  return view;
}

SideBySide compareSensor(const Setting& setting, const Sensor& sensor) {
  SideBySide side;
  side.sensor = sensor.name;
  const SensorLayer direct = measureDirect(setting.scene, setting.rays, sensor, setting.progress);
  for (const std::string& technique : setting.options.techniques)
    side.techniques.push_back(readTechnique(setting, technique, sensor, direct));
  const ReferenceSettings settings =
      referenceSettings(setting.options.reference, setting.options.technique, sensor.resolution);
  ReferenceSensor reference(setting.scene, setting.rays, sensor, settings);
  side.reference = refineReference(setting, reference, settings, sensor.name);
  return side;
}

std::vector<LeftOut> leftOutOf(const CompareOptions& options, const Scene& scene) {
  std::vector<LeftOut> all;
  const auto add = [&](const std::string& technique, std::span<const Omission> omissions) {
    for (const Omission& omission : omissions)
      all.push_back({technique, omission.what, omission.concerns(scene)});
  };
  add("", omissionsOfFrame());
  for (const TechniqueEntry& entry : techniques())
    if (std::count(options.techniques.begin(), options.techniques.end(), entry.name) > 0)
      add(entry.name, entry.omissions());
  return all;
}

void runCompare(const CompareOptions& options) {
  checkReportFolder(options.output);
  Progress progress(progressDisplay(options.isQuiet));
  const Scene scene = loadScene(options.scene, options.time);
  gpu::Device device({.device = options.device});
  const RayScene rays(scene);
  const Setting setting{options, scene, rays, device, progress};

  Comparison comparison;
  comparison.program = "nephroid " NEPHROID_VERSION;
  comparison.scene = options.scene.filename().string();
  comparison.commandLine = commandLine();
  comparison.device = device.info().name;
  comparison.time = options.time;
  comparison.exposure = scene.camera.exposure;
  const ReferenceSettings reference = referenceSettings(options.reference, options.technique, options.size);
  comparison.paths = nameOf(reference.paths);
  comparison.techniquePaths = nameOf(options.technique.paths);
  comparison.spectrum = reference.spectrum == Spectrum::channels ? "channels" : "continuous";
  comparison.photons = reference.photons;
  comparison.leftOut = leftOutOf(options, scene);
  comparison.view = compareView(setting);
  for (const Sensor& sensor : scene.sensors) comparison.sensors.push_back(compareSensor(setting, sensor));
  writeReport(options.output, comparison);
}

// All but the choice among them.
std::vector<std::string> comparedTechniques() {
  std::vector<std::string> names;
  for (const TechniqueEntry& entry : techniques())
    if (entry.name != std::string_view(kAutomaticName)) names.emplace_back(entry.name);
  return names;
}

void addTechniques(CLI::App& command, std::vector<std::string>& chosen) {
  const std::vector<std::string> names = comparedTechniques();
  chosen = names;
  command
      .add_option("--techniques", chosen,
                  "Which to compare, separated by commas: " + joined(names) + ". Left out: all of them")
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
      "compare", "Techniques held against the reference: a page with their images, errors and times");
  const auto options = std::make_shared<CompareOptions>();
  addScene(*command, options->scene);
  command
      ->add_option(
          "-o,--output", options->output,
          "The folder to write: index.html, which opens from disk; report.json; every image as EXR and PNG. "
          "A report that is there is replaced")
      ->required()
      ->type_name("REPORT_DIR");
  addSize(*command, options->size);
  addTime(*command, options->time);
  addTechniques(*command, options->techniques);
  addTechniqueSettings(*command, options->technique, false);
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
