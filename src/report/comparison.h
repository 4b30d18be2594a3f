// Images of techniques beside those of the reference: what a report is made of.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/image_io.h"
#include "core/shared_language.h"
#include "core/stats.h"
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
  double noise = 0;    // relative standard error, as the reference tells it
  double seconds = 0;  // that all passes took
  std::vector<ImageAttribute> attributes;
};

// What a camera sees (nit) or what falls on a sensor (lux).
struct SideBySide {
  std::string sensor;  // its name; empty for the camera
  ReferenceResult reference;
  std::vector<TechniqueResult> techniques;  // images of the reference's size
  // Of a camera: pixels in which no caster is in front, one a pixel. Empty: not known.
  std::vector<uint8_t> seesReceiver;
};

// Something left out of what the reference computes.
struct LeftOut {
  std::string technique;  // empty: by all of them
  std::string what;
  bool concernsScene = true;
};

struct Comparison {
  std::string program;  // "nephroid 1.2.3"
  std::string scene;    // its file's name
  std::string commandLine;
  std::string device;
  double time = 0;  // s, of what moves by itself
  float exposure = 1;
  std::string paths;           // the reference's: "transmission" or "all"
  std::string techniquePaths;  // the techniques'
  std::string spectrum;        // "channels" or "continuous"
  uint32_t photons = 0;        // of a pass of the reference
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

// Of a technique against the reference.
struct Errors {
  std::vector<LayerResult> layers;
  std::optional<FlipResult> flip;  // of pictures; sensors have none
};

// Of each technique: total, direct light and caustics, as far as the images have them; for a camera the
// caustics on receivers that no caster hides as well. Throws InputError where image sizes differ.
std::vector<Errors> errorsOf(const SideBySide& pair, float exposure);

// What follows from how reference and techniques were told to follow light: whether their difference is one
// of numbers alone.
std::string whatDiffers(const Comparison& comparison);

}  // namespace nephroid
