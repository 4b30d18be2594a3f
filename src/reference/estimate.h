// A picture that gets better pass by pass, and how far from the truth it may still be.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/shared_language.h"

namespace nephroid {

// The mean of what independent passes say of each pixel. All it knows is in floats, so that an image holds it
// whole: put back, it goes on as if it had never stopped.
class RunningMean {
 public:
  explicit RunningMean(std::size_t pixels) : mean(pixels, vec3(0)), variance(pixels, vec3(0)) {}

  // The `passes`-th pass, counted from one.
  void add(std::span<const vec3> pass, uint32_t passes);

  // R, G and B, named `prefix` + "R" and so on.
  void writeMean(Image& image, const std::string& prefix) const;
  // Of the mean, not of a pass: the square of its standard error. Without meaning before the second pass.
  void writeVariance(Image& image, const std::string& prefix) const;
  void writeStandardError(Image& image, const std::string& prefix) const;
  // Throws InputError where a channel is not there.
  void readMean(const Image& image, const std::string& prefix);
  void readVariance(const Image& image, const std::string& prefix);

  // The relative error where the light is: the standard errors over the values, both summed up, of the
  // brightest pixels, as many as hold 95 % of the light. Infinite where there is none.
  double noise() const;

 private:
  std::vector<vec3> mean;
  std::vector<vec3> variance;
};

}  // namespace nephroid
