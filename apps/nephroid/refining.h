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
  const CLI::Option *paths = nullptr, *error = nullptr;  // the options; tell whether the user gave them
};

// Adds the settings of the reference. To be called after addTechnique.
void addReference(CLI::App& command, ReferenceOptions& options);
// Adds --resume, for a command that writes one result.
void addResume(CLI::App& command, ReferenceOptions& options);

// The reference follows all paths, unless the user gave --paths. `size`: pixels or texels.
ReferenceSettings referenceSettings(const ReferenceOptions& options, const PictureSettings& picture,
                                    uvec2 size);

// When the reference stops: also at the error that the user gave with --error.
StopRule stopRule(const ReferenceOptions& options, const PictureSettings& picture);

// What refineToFile needs to know about its output file.
struct ReferenceJob {
  const CommonOptions& common;
  const ReferenceOptions& options;
  const ReferenceSettings& settings;
  const StopRule& stop;
  const Scene& scene;
  std::string unit;    // "nit", "lux"
  std::string sensor;  // its name; empty for an image
};

// The attributes of an EXR that tell which passes are in it.
std::vector<ImageAttribute> referenceAttributes(const Estimate& estimate, const ReferenceJob& job);

// Adds passes to the estimate until the user's stop rule is met. With --resume it first loads the passes that
// the output file already holds. Writes the file from time to time and at the end. After Ctrl-C it writes the
// file too, and then throws Interrupted.
void refineToFile(Estimate& estimate, const ReferenceJob& job, Progress& progress, Stats& stats);

}  // namespace nephroid
