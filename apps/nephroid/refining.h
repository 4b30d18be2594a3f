// The reference on the command line: when to stop, what to keep, how to go on.
#pragma once

#include <CLI/CLI.hpp>

#include "command.h"
#include "reference/refine.h"
#include "scene/scene.h"

namespace nephroid {

struct ReferenceOptions {
  StopRule stop;
  uint64_t seed = 1;
  uint32_t photons = 1u << 20;  // a pass
  bool resumes = false;
  const CLI::Option* paths = nullptr;     // of the technique; whether they were given
  const CLI::Option* spectrum = nullptr;  // whether it was given
  Spectrum givenSpectrum = Spectrum::continuous;
};

// --passes, --seconds, --error, --seed, --photons, --spectrum; after addTechnique.
void addReference(CLI::App& command, ReferenceOptions& options);
// --resume, for a command that writes one result.
void addResume(CLI::App& command, ReferenceOptions& options);

// All paths unless others were asked for; wavelengths, but for transmission alone the channels that the
// papers' model has.
ReferenceSettings referenceSettings(const ReferenceOptions& options, const TechniqueSettings& technique,
                                    uvec2 size);

// When to stop where the user did not say.
StopRule stopRuleOf(const ReferenceOptions& options);

// What a result is written as: the output, and what its file says of itself.
struct ReferenceJob {
  const CommonOptions& common;
  const ReferenceOptions& options;
  const ReferenceSettings& settings;
  const Scene& scene;
  std::string unit;    // "nit", "lux"
  std::string sensor;  // its name; empty for an image
};

// What an EXR says of the passes in it.
std::vector<ImageAttribute> referenceAttributes(const Estimate& estimate, const ReferenceJob& job);

// Refines the estimate by the user's rule, from the file's own state with --resume, and writes it, now and
// then and at the end. Throws Interrupted when the user ended it, after writing what there is.
void refineToFile(Estimate& estimate, const ReferenceJob& job, Progress& progress, Stats& stats);

}  // namespace nephroid
