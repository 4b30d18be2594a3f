// The running mean of an image over passes, and its standard error.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/image.h"
#include "core/shared_language.h"

namespace nephroid {

// The mean of independent passes for each pixel, and its variance. The whole state is in floats, so that it
// can be stored in an image and continued later with the same result.
class RunningMean {
 public:
  explicit RunningMean(std::size_t pixels) : mean_(pixels, vec3(0)), variance_(pixels, vec3(0)) {}

  // Adds a pass. `passes`: the number of passes with this one.
  void add(std::span<const vec3> pass, uint32_t passes);

  // Writes the channels `prefix` + "R", "G" and "B".
  void writeMean(Image& image, const std::string& prefix) const;
  // The variance is that of the mean, not of a pass: the square of its standard error. Without meaning before
  // the second pass.
  void writeVariance(Image& image, const std::string& prefix) const;
  void writeStandardError(Image& image, const std::string& prefix) const;
  // Throws InputError where a channel is not there.
  void readMean(const Image& image, const std::string& prefix);
  void readVariance(const Image& image, const std::string& prefix);

  // The relative standard error: the sum of standard errors divided by the sum of values, over the brightest
  // pixels that together hold 95 % of the light. Infinite where there is no light.
  double noise() const;

 private:
  std::vector<vec3> mean_;
  std::vector<vec3> variance_;
};

// That of the caustics, or of all light where there are no caustics. Infinite before the second pass: one
// pass tells nothing of its own spread.
double noiseOf(uint32_t passes, const RunningMean& caustics, const RunningMean& total);

}  // namespace nephroid
