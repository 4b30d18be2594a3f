#include "report/metrics.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace nephroid {
namespace {

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

using Channels = std::array<const std::vector<float>*, 3>;

Channels channelsOf(const Image& image, const std::string& layer) {
  return {image.find(layer + "R"), image.find(layer + "G"), image.find(layer + "B")};
}

bool areThere(const Channels& channels) {
  return std::all_of(channels.begin(), channels.end(), [](const auto* values) { return values != nullptr; });
}

double ratio(double numerator, double denominator) {
  return denominator > 0 ? numerator / denominator : kNotANumber;
}

// A layer of the image beside that of the reference.
class Pair {
 public:
  Pair(const Image& reference, const Image& image, const std::string& layer)
      : reference_(channelsOf(reference, layer)),
        image_(channelsOf(image, layer)),
        variance_(channelsOf(reference, layer + "variance.")),
        hasVariance_(areThere(variance_)),
        pixels_(reference.pixelCount()) {}

  std::size_t pixels() const { return pixels_; }
  bool hasVariance() const { return hasVariance_; }
  double reference(std::size_t pixel, std::size_t c) const { return double((*reference_[c])[pixel]); }
  double difference(std::size_t pixel, std::size_t c) const {
    return double((*image_[c])[pixel]) - reference(pixel, c);
  }
  double variance(std::size_t pixel, std::size_t c) const {
    return hasVariance_ ? double((*variance_[c])[pixel]) : 0.0;
  }
  // Summed over channels.
  double reference(std::size_t pixel) const {
    return reference(pixel, 0) + reference(pixel, 1) + reference(pixel, 2);
  }
  // Photons have all three channels at once, so standard errors add up as they are.
  bool counts(std::size_t pixel) const {
    double standardError = 0;
    for (std::size_t c = 0; c < 3; ++c) standardError += std::sqrt(variance(pixel, c));
    return reference(pixel) > standardError;
  }

 private:
  Channels reference_, image_, variance_;
  bool hasVariance_;
  std::size_t pixels_;
};

void addPercentage(const Pair& pair, LayerErrors& errors) {
  double sum = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < pair.pixels(); ++i) {
    if (!pair.counts(i)) continue;
    double difference = 0;
    for (std::size_t c = 0; c < 3; ++c) difference += std::abs(pair.difference(i, c));
    sum += difference / pair.reference(i);
    ++counted;
  }
  errors.mape = ratio(sum, double(counted));
  errors.countedFraction = ratio(double(counted), double(pair.pixels()));
}

void addNoise(const Pair& pair, LayerErrors& errors) {
  double variance = 0, squares = 0;
  std::size_t counted = 0;
  for (std::size_t i = 0; i < pair.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      variance += pair.variance(i, c);
      if (pair.variance(i, c) <= 0) continue;
      squares += pair.difference(i, c) * pair.difference(i, c) / pair.variance(i, c);
      ++counted;
    }
  errors.noiseFloor = ratio(std::sqrt(variance / (3 * double(pair.pixels()))), errors.referenceMean);
  if (counted > 0) errors.zScoreRms = std::sqrt(squares / double(counted));
}

template <class Value>
std::vector<float> forEachPixel(std::size_t pixels, const Value& value) {
  std::vector<float> values(pixels);
  for (std::size_t i = 0; i < pixels; ++i) values[i] = float(value(i));
  return values;
}

}  // namespace

bool hasLayer(const Image& image, const std::string& layer) {
  return areThere(channelsOf(image, layer));
}

LayerErrors layerErrors(const Image& reference, const Image& image, const std::string& layer) {
  const Pair pair(reference, image, layer);
  double ofReference = 0, ofDifference = 0, squares = 0;
  for (std::size_t i = 0; i < pair.pixels(); ++i)
    for (std::size_t c = 0; c < 3; ++c) {
      const double difference = pair.difference(i, c);
      ofReference += pair.reference(i, c);
      ofDifference += difference;
      squares += difference * difference;
    }
  const double samples = 3 * double(pair.pixels());
  LayerErrors errors;
  errors.referenceMean = ofReference / samples;
  errors.fluxRatio = ratio(ofReference + ofDifference, ofReference);
  errors.relativeRmse = ratio(std::sqrt(squares / samples), errors.referenceMean);
  addPercentage(pair, errors);
  if (pair.hasVariance()) addNoise(pair, errors);
  return errors;
}

std::vector<float> relativeErrors(const Image& reference, const Image& image, const std::string& layer) {
  const Pair pair(reference, image, layer);
  return forEachPixel(pair.pixels(), [&](std::size_t i) {
    const double difference = pair.difference(i, 0) + pair.difference(i, 1) + pair.difference(i, 2);
    return pair.counts(i) ? difference / pair.reference(i) : kNotANumber;
  });
}

std::vector<float> absoluteErrors(const Image& reference, const Image& image, const std::string& layer) {
  const Pair pair(reference, image, layer);
  return forEachPixel(pair.pixels(), [&](std::size_t i) {
    return (std::abs(pair.difference(i, 0)) + std::abs(pair.difference(i, 1)) +
            std::abs(pair.difference(i, 2))) /
           3;
  });
}

std::vector<float> channelMeans(const Image& image, const std::string& layer) {
  const Channels channels = channelsOf(image, layer);
  return forEachPixel(image.pixelCount(), [&](std::size_t i) {
    return (double((*channels[0])[i]) + double((*channels[1])[i]) + double((*channels[2])[i])) / 3;
  });
}

Image pixelsOf(const Image& image, const std::vector<uint8_t>& chosen) {
  Image some;
  some.width = uint32_t(std::count_if(chosen.begin(), chosen.end(), [](uint8_t is) { return is != 0; }));
  some.height = 1;
  for (const ImageChannel& channel : image.channels) {
    std::vector<float>& values = some.channel(channel.name);
    auto next = values.begin();
    for (std::size_t i = 0; i < chosen.size(); ++i)
      if (chosen[i]) *next++ = channel.values[i];
  }
  return some;
}

double quantile(std::vector<float> values, double fraction) {
  std::erase_if(values, [](float value) { return std::isnan(value); });
  if (values.empty()) return 0;
  const auto rank = std::ptrdiff_t(fraction * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return double(values[std::size_t(rank)]);
}

}  // namespace nephroid
