#include "refining.h"

#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "core/interrupt.h"
#include "reference/fingerprint.h"
#include "render/picture.h"

namespace nephroid {
namespace {

constexpr uint32_t kDefaultPasses = 64;
constexpr uint32_t kMostPhotons = 1u << 24;

// "0.01" or "1%".
double fractionOf(const std::string& text) {
  const bool isPercent = !text.empty() && text.back() == '%';
  double value = 0;
  const bool isNumber = CLI::detail::lexical_cast(isPercent ? text.substr(0, text.size() - 1) : text, value);
  if (!isNumber || !(value > 0) || !std::isfinite(value))
    throw CLI::ValidationError("--error",
                               "'" + text + "' is not a relative error above zero, such as 0.01 or 1%");
  return isPercent ? value / 100 : value;
}

std::string hexadecimal(uint64_t value) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(value));
  return text;
}

// What has to be the same for passes to be added to those of a file.
std::string stateKey(const ReferenceJob& job) {
  const ReferenceSettings& s = job.settings;
  Hasher hasher;
  hasher.add(fingerprint(job.scene));
  hasher.add(s.size.x);
  hasher.add(s.size.y);
  hasher.add(static_cast<uint32_t>(s.paths));
  hasher.add(static_cast<uint32_t>(s.spectrum));
  hasher.add(s.seed);
  hasher.add(s.photons);
  hasher.add(std::as_bytes(std::span(job.sensor)));
  return hexadecimal(hasher.value());
}

void write(const Estimate& estimate, const ReferenceJob& job) {
  const std::filesystem::path& output = job.common.output;
  const Image image = estimate.image();
  if (output.extension() == ".png")
    writePng(output, pictureOf(image, job.scene.camera.exposure));
  else
    writeExr(output, image, referenceAttributes(estimate, job));
}

template <class T>
const T* attribute(const std::vector<ImageAttribute>& attributes, const char* name) {
  for (const ImageAttribute& each : attributes)
    if (each.name == name) return std::get_if<T>(&each.value);
  return nullptr;
}

void resume(Estimate& estimate, const ReferenceJob& job) {
  const std::filesystem::path& file = job.common.output;
  if (file.extension() != ".exr")
    throw InputError("--resume: only an .exr can be gone on with, not '" + file.string() + "'");
  if (!std::filesystem::exists(file)) return;
  const std::vector<ImageAttribute> attributes = readExrAttributes(file);
  const auto* key = attribute<std::string>(attributes, "state");
  const auto* passes = attribute<int>(attributes, "passes");
  if (!key || !passes || *passes < 0)
    throw InputError("--resume: '" + file.string() +
                     "' was not written by --technique reference; name another file");
  if (*key != stateKey(job))
    throw InputError(
        "--resume: '" + file.string() +
        "' was made of another scene, or with another size, time, seed, --photons, --paths or --spectrum; "
        "use the same, or name another file");
  estimate.restore(readExr(file), static_cast<uint32_t>(*passes));
}

}  // namespace

void addReference(CLI::App& command, ReferenceOptions& options) {
  const char* group = "Reference";
  command
      .add_option("--passes", options.stop.passes,
                  "Stop the reference after so many passes; 64 where no reason is given")
      ->check(CLI::Range(1u, 1000000000u))
      ->type_name("N")
      ->group(group);
  command.add_option("--seconds", options.stop.seconds, "Stop it after so long")
      ->check(CLI::Range(0.001, 1e9))
      ->type_name("SECONDS")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--error", [&options](const std::string& text) { options.stop.error = fractionOf(text); },
          "Stop it when the standard error of the caustics, over their value where they are, is this: 0.01 "
          "or 1%")
      ->type_name("FRACTION")
      ->group(group);
  command.add_option("--seed", options.seed, "Of its random numbers")
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  command.add_option("--photons", options.photons, "Photons that it traces in a pass")
      ->check(CLI::Range(1u, kMostPhotons))
      ->type_name("N")
      ->capture_default_str()
      ->group(group);
  options.spectrum = command
                         .add_option_function<std::string>(
                             "--spectrum",
                             [&options](const std::string& name) {
                               options.givenSpectrum =
                                   name == "channels" ? Spectrum::channels : Spectrum::continuous;
                             },
                             "Dispersion in the reference: red, green and blue with an index each, or "
                             "wavelengths. Left out: "
                             "channels with --paths transmission, as the techniques; or else continuous")
                         ->check(oneOf({"channels", "continuous"}))
                         ->type_name("channels|continuous")
                         ->group(group);
  options.paths = command.get_option("--paths");
}

void addResume(CLI::App& command, ReferenceOptions& options) {
  command.add_flag("--resume", options.resumes, "Go on with the passes of the output, where it exists")
      ->group("Reference");
}

ReferenceSettings referenceSettings(const ReferenceOptions& options, const TechniqueSettings& technique,
                                    uvec2 size) {
  ReferenceSettings settings;
  settings.size = size;
  settings.paths = options.paths->count() > 0 ? technique.paths : Paths::all;
  settings.spectrum = options.spectrum->count() > 0           ? options.givenSpectrum
                      : settings.paths == Paths::transmission ? Spectrum::channels
                                                              : Spectrum::continuous;
  settings.seed = options.seed;
  settings.photons = options.photons;
  return settings;
}

StopRule stopRuleOf(const ReferenceOptions& options) {
  StopRule rule = options.stop;
  if (rule.passes == 0 && rule.seconds <= 0 && rule.error <= 0) rule.passes = kDefaultPasses;
  return rule;
}

std::vector<ImageAttribute> referenceAttributes(const Estimate& estimate, const ReferenceJob& job) {
  return {{"software", std::string("nephroid ") + NEPHROID_VERSION},
          {"commandLine", commandLine()},
          {"technique", std::string("reference")},
          {"paths", std::string(nameOf(job.settings.paths))},
          {"spectrum", std::string(job.settings.spectrum == Spectrum::channels ? "channels" : "continuous")},
          {"seed", std::to_string(job.settings.seed)},
          {"photonsPerPass", static_cast<int>(job.settings.photons)},
          {"passes", static_cast<int>(estimate.passes())},
          {"relativeStandardError", static_cast<float>(estimate.noise())},
          {"sceneTime", static_cast<float>(job.common.time)},
          {"state", stateKey(job)},
          {"unit", job.unit}};
}

void refineToFile(Estimate& estimate, const ReferenceJob& job, Progress& progress, Stats& stats) {
  if (job.options.resumes) resume(estimate, job);
  const uint32_t before = estimate.passes();
  const Stopwatch watch;
  const bool isDone = refine(estimate, stopRuleOf(job.options), progress, [&] { write(estimate, job); });
  const uint32_t made = estimate.passes() - before;
  stats.frameMilliseconds = made > 0 ? watch.milliseconds() / made : 0;
  stats.counts.emplace_back("passes", estimate.passes());
  stats.counts.emplace_back("photons", uint64_t(estimate.passes()) * job.settings.photons);
  write(estimate, job);
  if (!isDone)
    throw Interrupted("interrupted; " + std::to_string(estimate.passes()) + " passes are in '" +
                      job.common.output.string() + "'" +
                      (job.common.output.extension() == ".exr" ? ", and --resume goes on with them" : ""));
}

}  // namespace nephroid
