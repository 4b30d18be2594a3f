// The reference on the command line: when to stop, what to keep, how to go on.
#pragma once

#include <CLI/CLI.hpp>

#include "command.h"
#include "reference/refine.h"
#include "reference/settings.h"
#include "scene/scene.h"

namespace nephroid {

struct ReferenceOptions {
  ReferenceChoices choices;
  bool resumes = false;
  const CLI::Option* paths = nullptr;  // of the technique; whether they were given
};

// The settings of the reference; after addTechnique.
void addReference(CLI::App& command, ReferenceOptions& options);
// --resume, for a command that writes one result.
void addResume(CLI::App& command, ReferenceOptions& options);

// All paths unless others were asked for.
ReferenceSettings referenceSettings(const ReferenceOptions& options, const PictureSettings& picture,
                                    uvec2 size);

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
