#include "reference/estimate.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "core/error.h"

namespace nephroid {
namespace {

template <class Function>
void writeChannels(Image& image, const std::string& prefix, const std::vector<vec3>& values,
                   const Function& valueOf) {
  for (int c = 0; c < 3; ++c) {
    std::vector<float>& channel = image.channel(prefix + "RGB"[c]);
    for (std::size_t i = 0; i < values.size(); ++i) channel[i] = valueOf(values[i][c]);
  }
}

void readChannels(const Image& image, const std::string& prefix, std::vector<vec3>& values) {
  for (int c = 0; c < 3; ++c) {
    const std::string name = prefix + "RGB"[c];
    const std::vector<float>* channel = image.find(name);
    if (!channel || channel->size() != values.size())
      throw InputError("the image to go on with has no channel '" + name + "' of the size asked for");
    for (std::size_t i = 0; i < values.size(); ++i) values[i][c] = (*channel)[i];
  }
}

float same(float value) {
  return value;
}

}  // namespace

// Welford 1962, for the variance of the mean: v' = v (n - 1) / (n + 1) + (d / (n + 1))^2 after n passes.
void RunningMean::add(std::span<const vec3> pass, uint32_t passes) {
  const auto count = static_cast<float>(passes);
  const float kept = passes > 1 ? (count - 2) / count : 0;
  for (std::size_t i = 0; i < pass.size(); ++i) {
    const vec3 step = (pass[i] - mean_[i]) / count;
    variance_[i] = passes > 1 ? variance_[i] * kept + step * step : vec3(0);
    mean_[i] += step;
  }
}

void RunningMean::writeMean(Image& image, const std::string& prefix) const {
  writeChannels(image, prefix, mean_, same);
}

void RunningMean::writeVariance(Image& image, const std::string& prefix) const {
  writeChannels(image, prefix, variance_, same);
}

void RunningMean::writeStandardError(Image& image, const std::string& prefix) const {
  writeChannels(image, prefix, variance_, [](float value) { return std::sqrt(value); });
}

void RunningMean::readMean(const Image& image, const std::string& prefix) {
  readChannels(image, prefix, mean_);
}

void RunningMean::readVariance(const Image& image, const std::string& prefix) {
  readChannels(image, prefix, variance_);
}

double RunningMean::noise() const {
  constexpr double kShare = 0.95;
  std::vector<std::pair<float, float>> pixels;  // value, standard error
  double light = 0;
  for (std::size_t i = 0; i < mean_.size(); ++i) {
    const float value = mean_[i].x + mean_[i].y + mean_[i].z;
    if (value <= 0) continue;
    const vec3 error = glm::sqrt(variance_[i]);
    pixels.emplace_back(value, error.x + error.y + error.z);
    light += double(value);
  }
  std::sort(pixels.begin(), pixels.end(), std::greater<>());
  double values = 0, errors = 0;
  for (const auto& [value, error] : pixels) {
    values += double(value);
    errors += double(error);
    if (values >= kShare * light) break;
  }
  return values > 0 ? errors / values : std::numeric_limits<double>::infinity();
}

double noiseOf(uint32_t passes, const RunningMean& caustics, const RunningMean& total) {
  if (passes < 2) return std::numeric_limits<double>::infinity();
  const double ofCaustics = caustics.noise();
  return std::isfinite(ofCaustics) ? ofCaustics : total.noise();
}

}  // namespace nephroid
