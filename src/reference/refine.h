// Passes until it is good enough.
#pragma once

#include <functional>

#include "core/image.h"
#include "core/progress.h"
#include "reference/spectrum.h"
#include "trace/paths.h"

namespace nephroid {

// How photons come into the picture where no caster is between them and the camera: one by one with no
// kernel, or as elsewhere, by a disc that shrinks from pass to pass.
enum class SeenDirectly { splatted, gathered };

struct ReferenceSettings {
  uvec2 size{640, 480};  // pixels of an image; a sensor has its own
  Paths paths = Paths::all;
  Spectrum spectrum = Spectrum::continuous;
  uint64_t seed = 1;
  uint32_t photons = 1u << 20;  // of a pass, at most 2^24
  SeenDirectly seenDirectly = SeenDirectly::splatted;
};

// Something estimated by passes. Each depends on the settings and its own number alone, so that the result
// does not depend on threads, nor on where it was interrupted and gone on with.
class Estimate {
 public:
  Estimate() = default;
  Estimate(const Estimate&) = delete;
  Estimate& operator=(const Estimate&) = delete;
  virtual ~Estimate() = default;

  virtual void pass() = 0;
  uint32_t passes() const { return passesDone; }
  // Relative standard error, as RunningMean::noise: of caustics where there are any, or else of all the
  // light.
  virtual double noise() const = 0;
  virtual Image image() const = 0;
  // Goes on from image(), made with the same scene and settings after so many passes. Throws InputError where
  // the image does not fit.
  virtual void restore(const Image& image, uint32_t passes) = 0;

 protected:
  uint32_t passesDone = 0;
};

// Whichever comes first; 0: no reason to stop. All 0: never.
struct StopRule {
  uint32_t passes = 0;
  double seconds = 0;
  double error = 0;  // relative standard error, 0.01 for 1 %
};

// Passes until `rule` says stop or the user does; true: the rule. Shows the error so far. `keep` is called
// now and then with what there is.
bool refine(Estimate& estimate, const StopRule& rule, Progress& progress,
            const std::function<void()>& keep = {});

}  // namespace nephroid
