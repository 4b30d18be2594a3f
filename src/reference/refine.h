// The interface of what the reference estimates, and the loop that adds passes to it.
#pragma once

#include <functional>

#include "core/image.h"
#include "core/progress.h"
#include "reference/spectrum.h"
#include "trace/paths.h"

namespace nephroid {

// How photons enter the picture where no caster is between them and the camera. splatted: each is added to
// its pixel, without a kernel. gathered: as elsewhere, within a disk that shrinks from pass to pass.
enum class SeenDirectly { splatted, gathered };

struct ReferenceSettings {
  uvec2 size{640, 480};  // pixels of an image; a sensor has its own
  Paths paths = Paths::all;
  Spectrum spectrum = Spectrum::continuous;
  uint64_t seed = 1;
  uint32_t photons = 1u << 20;  // of a pass, at most 2^24
  uint32_t pilots = 1u << 18;   // photons that find out where others are to be sent; 0: evenly
  SeenDirectly seenDirectly = SeenDirectly::splatted;
};

// An image that is estimated by passes. Each pass depends only on the settings and its own number. So the
// result does not depend on threads, or on interruptions after which it was continued.
class Estimate {
 public:
  Estimate() = default;
  Estimate(const Estimate&) = delete;
  Estimate& operator=(const Estimate&) = delete;
  virtual ~Estimate() = default;

  virtual void pass() = 0;
  uint32_t passes() const { return passesDone_; }
  // The relative standard error of what was found so far (noiseOf).
  virtual double noise() const = 0;
  virtual Image image() const = 0;
  // Continues from `image`, which image() returned after `passes` passes for the same scene and settings.
  // Throws InputError where the image does not fit.
  virtual void restore(const Image& image, uint32_t passes) = 0;

 protected:
  uint32_t passesDone_ = 0;
};

// When to stop: at the first limit that is reached. 0: no limit. All 0: never.
struct StopRule {
  uint32_t passes = 0;
  double seconds = 0;
  double error = 0;  // relative standard error, 0.01 for 1 %
};

// Adds passes until `rule` is met or the user interrupts. Returns true where the rule was met. Shows the
// present error as progress. `keep` is called from time to time, to store the present state.
bool refine(Estimate& estimate, const StopRule& rule, Progress& progress,
            const std::function<void()>& keep = {});

}  // namespace nephroid
