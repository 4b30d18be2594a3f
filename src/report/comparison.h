// The content of a report: images of techniques and of the reference.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/image_io.h"
#include "core/shared_language.h"
#include "core/stats.h"
#include "render/tone_mapping.h"
#include "report/metrics.h"

namespace nephroid {

struct TechniqueResult {
  Image image;                             // linear: R,G,B and direct., caustics., ...
  Stats stats;                             // names the technique
  std::vector<ImageAttribute> attributes;  // of the EXR that is written
};

struct ReferenceResult {
  Image image;  // as a technique's, with variance.R,G,B and caustics.variance.R,G,B
  uint32_t passes = 0;
  double noise = 0;    // relative standard error of the reference
  double seconds = 0;  // time of all passes
  std::vector<ImageAttribute> attributes;
};

// The results for the camera (nit) or for a sensor (lux).
struct SideBySide {
  std::string sensor;  // its name; empty for the camera
  ReferenceResult reference;
  std::vector<TechniqueResult> techniques;  // images of the reference's size
  // For a camera: 1 for each pixel in which no caster is in front, else 0, row by row. Empty: not known.
  std::vector<uint8_t> seesReceiver;
};

// An effect that the reference computes and a technique does not.
struct LeftOut {
  std::string technique;  // empty: all techniques
  std::string what;
  bool concernsScene = true;
};

struct Comparison {
  std::string program;  // "nephroid 1.2.3"
  std::string scene;    // its file's name
  std::string commandLine;
  std::string device;
  double time = 0;                           // s, the scene's time
  ToneMapping toneMapping{1, kToneNeutral};  // of all pictures
  std::string paths;                         // the reference's: "transmission" or "all"
  std::string techniquePaths;                // the techniques'
  std::string spectrum;                      // "channels" or "continuous"
  uint32_t photons = 0;                      // in a pass of the reference
  std::vector<LeftOut> leftOut;
  SideBySide view;
  std::vector<SideBySide> sensors;
};

struct LayerResult {
  std::string name;  // "total", "caustics"
  LayerErrors errors;
};

struct FlipResult {
  std::vector<float> map;  // row by row
  double mean = 0;
  double maximum = 0;
};

// The errors of a technique against the reference.
struct Errors {
  std::vector<LayerResult> layers;
  std::optional<FlipResult> flip;  // for pictures; sensors have none
};

// The errors of each technique: of the total, of direct light and of caustics, where the images have these
// layers. For a camera also of the caustics in pixels without a caster in front. Throws InputError where
// image sizes differ.
std::vector<Errors> errorsOf(const SideBySide& pair, const ToneMapping& toneMapping);

// A sentence for the reader of the report: whether reference and techniques follow the same paths of light,
// so that only numerical errors remain.
std::string whatDiffers(const Comparison& comparison);

}  // namespace nephroid
