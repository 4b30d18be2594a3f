#include "refining.h"

#include <cmath>

#include "core/error.h"
#include "core/hash.h"
#include "core/interrupt.h"
#include "reference/fingerprint.h"
#include "render/metering.h"
#include "render/picture.h"

namespace nephroid {
namespace {

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
    return writePng(output, pictureOf(image, toneMappingOf(job.scene.camera, image)));
  std::vector<ImageAttribute> attributes = referenceAttributes(estimate, job);
  if (job.sensor.empty()) addToneAttributes(toneMappingOf(job.scene.camera, image), attributes);
  writeExr(output, image, attributes);
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
    throw InputError("--resume: '" + file.string() +
                     "' was made of another scene, by another version, or with another size, time, seed, "
                     "--photons, --paths or --spectrum; "
                     "use the same, or name another file");
  estimate.restore(readExr(file), static_cast<uint32_t>(*passes));
}

}  // namespace

void addReference(CLI::App& command, ReferenceOptions& options) {
  const SettingsView view{"Reference", referenceSettings(), &options.choices};
  addSettings(command, {&view, 1});
  options.paths = command.get_option("--paths");
  options.error = command.get_option("--error");
}

void addResume(CLI::App& command, ReferenceOptions& options) {
  command.add_flag("--resume", options.resumes, "If the output file exists, continue from the passes in it")
      ->group("Reference");
}

ReferenceSettings referenceSettings(const ReferenceOptions& options, const PictureSettings& picture,
                                    uvec2 size) {
  const Paths paths = options.paths->count() > 0 ? picture.technique.transport.paths : Paths::all;
  return referenceSettingsOf(options.choices, paths, size);
}

StopRule stopRule(const ReferenceOptions& options, const PictureSettings& picture) {
  const bool isAsked = options.error->count() > 0;
  return stopRuleOf(options.choices, isAsked ? double(accuracyOf(picture.technique).error) : 0);
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
  const bool isDone = refine(estimate, job.stop, progress, [&] { write(estimate, job); });
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
