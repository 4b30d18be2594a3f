#include "report/flip.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/constants.hpp>

#include "core/image_io.h"

namespace nephroid {
namespace {

using glm::vec3;

// The paper's constants: exponents of the color and the feature difference, the knee of the color errors'
// redistribution, and the width of the feature detectors in degrees.
constexpr float kColorExponent = 0.7f;
constexpr float kFeatureExponent = 0.5f;
constexpr float kKneeIn = 0.4f;
constexpr float kKneeOut = 0.95f;
constexpr double kFeatureWidth = 0.082;

// sum of a sqrt(pi / b) exp(-pi^2 x^2 / b), x in degrees: the spatial contrast sensitivity of the achromatic,
// red-green and blue-yellow channels.
struct Gaussian {
  double a, b;
};
constexpr std::array<std::array<Gaussian, 2>, 3> kSensitivities{
    {{{{1, 0.0047}, {0, 1}}}, {{{1, 0.0053}, {0, 1}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
constexpr double kWidestGaussian = 0.04;

constexpr vec3 kWhite{0.950428545f, 1.0f, 1.088900371f};  // XYZ of D65

struct Plane {
  int width, height;
  std::vector<float> values;
};

// Weights at -radius .. radius.
using Kernel = std::vector<double>;

vec3 xyzOf(vec3 linear) {
  constexpr float kDenominator = 73733382.0f;
  return {(30406656.0f * linear.r + 26366430.0f * linear.g + 13305225.0f * linear.b) / kDenominator,
          (15678432.0f * linear.r + 52732860.0f * linear.g + 5322090.0f * linear.b) / kDenominator,
          (1425312.0f * linear.r + 8788810.0f * linear.g + 70074185.0f * linear.b) / kDenominator};
}

vec3 linearOf(vec3 xyz) {
  static const glm::mat3 kInverse =
      glm::inverse(glm::mat3(xyzOf({1, 0, 0}), xyzOf({0, 1, 0}), xyzOf({0, 0, 1})));
  return kInverse * xyz;
}

// YCxCz: CIELAB without its cube roots.
vec3 opponentOf(vec3 linear) {
  const vec3 xyz = xyzOf(linear) / kWhite;
  return {116 * xyz.y - 16, 500 * (xyz.x - xyz.y), 200 * (xyz.y - xyz.z)};
}

vec3 linearOfOpponent(vec3 opponent) {
  const float y = (opponent.x + 16) / 116;
  return linearOf(vec3(y + opponent.y / 500, y, y - opponent.z / 200) * kWhite);
}

// CIELAB, its chroma adjusted by lightness after Hunt.
vec3 huntLabOf(vec3 linear) {
  constexpr float kDelta = 6.0f / 29.0f;
  vec3 f = xyzOf(linear) / kWhite;
  for (int c = 0; c < 3; ++c)
    f[c] = f[c] > kDelta * kDelta * kDelta ? std::cbrt(f[c]) : f[c] / (3 * kDelta * kDelta) + 4.0f / 29.0f;
  const float lightness = 116 * f.y - 16;
  return {lightness, 0.01f * lightness * 500 * (f.x - f.y), 0.01f * lightness * 200 * (f.y - f.z)};
}

// City-block in lightness, Euclidean in chroma.
float hybridDistance(vec3 a, vec3 b) {
  return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

// Borders go on as they end.
Plane filtered(const Plane& in, const Kernel& alongX, const Kernel& alongY) {
  const auto pass = [](const Plane& from, const Kernel& kernel, bool isVertical) {
    Plane to{from.width, from.height, std::vector<float>(from.values.size())};
    const int radius = int(kernel.size() / 2);
    oneapi::tbb::parallel_for(0, from.height, [&](int y) {
      for (int x = 0; x < from.width; ++x) {
        double sum = 0;
        for (int i = -radius; i <= radius; ++i) {
          const int column = isVertical ? x : std::clamp(x + i, 0, from.width - 1);
          const int row = isVertical ? std::clamp(y + i, 0, from.height - 1) : y;
          sum +=
              kernel[std::size_t(i + radius)] * double(from.values[std::size_t(row * from.width + column)]);
        }
        to.values[std::size_t(y * from.width + x)] = float(sum);
      }
    });
    return to;
  };
  return pass(pass(in, alongX, false), alongY, true);
}

template <class Weight>
Kernel kernelOf(int radius, const Weight& weight) {
  Kernel kernel;
  for (int i = -radius; i <= radius; ++i) kernel.push_back(weight(double(i)));
  return kernel;
}

double sumOf(const Kernel& kernel) {
  double sum = 0;
  for (const double weight : kernel) sum += weight;
  return sum;
}

void scale(Kernel& kernel, double factor) {
  for (double& weight : kernel) weight *= factor;
}

// What is seen of a channel at a distance: each Gaussian is filtered along rows, then columns.
Plane seenFromAfar(const Plane& channel, const std::array<Gaussian, 2>& sensitivity, double pixelsPerDegree) {
  constexpr double kPi = glm::pi<double>();
  const int radius = int(std::ceil(3 * std::sqrt(kWidestGaussian / (2 * kPi * kPi)) * pixelsPerDegree));
  std::array<Kernel, 2> kernels;
  std::array<double, 2> parts{};
  for (std::size_t i = 0; i < 2; ++i) {
    const auto [a, b] = sensitivity[i];
    const double exponent = -kPi * kPi / (b * pixelsPerDegree * pixelsPerDegree);
    kernels[i] = kernelOf(radius, [&](double x) { return std::exp(exponent * x * x); });
    const double sum = sumOf(kernels[i]);
    parts[i] = a * std::sqrt(kPi / b) * sum * sum;
    scale(kernels[i], 1 / sum);
  }
  Plane seen{channel.width, channel.height, std::vector<float>(channel.values.size(), 0)};
  for (std::size_t i = 0; i < 2; ++i) {
    if (parts[i] == 0) continue;
    const float part = float(parts[i] / (parts[0] + parts[1]));
    const Plane one = filtered(channel, kernels[i], kernels[i]);
    for (std::size_t j = 0; j < seen.values.size(); ++j) seen.values[j] += part * one.values[j];
  }
  return seen;
}

// A picture in opponent channels.
std::array<Plane, 3> opponentChannels(const ByteImage& picture) {
  Plane empty{int(picture.width), int(picture.height), {}};
  empty.values.resize(std::size_t(picture.width) * picture.height);
  std::array<Plane, 3> channels{empty, empty, empty};
  for (std::size_t i = 0; i < empty.values.size(); ++i) {
    vec3 linear;
    for (int c = 0; c < 3; ++c)
      linear[c] = linearFromSrgb(float(picture.bytes[i * picture.components + std::size_t(c)]) / 255.0f);
    const vec3 opponent = opponentOf(linear);
    for (std::size_t c = 0; c < 3; ++c) channels[c].values[i] = opponent[int(c)];
  }
  return channels;
}

std::vector<vec3> perceivedColors(const std::array<Plane, 3>& opponent, double pixelsPerDegree) {
  std::array<Plane, 3> seen;
  for (std::size_t c = 0; c < 3; ++c) seen[c] = seenFromAfar(opponent[c], kSensitivities[c], pixelsPerDegree);
  std::vector<vec3> colors(seen[0].values.size());
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const vec3 linear = linearOfOpponent({seen[0].values[i], seen[1].values[i], seen[2].values[i]});
    colors[i] = huntLabOf(glm::clamp(linear, 0.0f, 1.0f));
  }
  return colors;
}

// Color differences from 0 to the largest there is, green to blue, onto 0 to 1.
float redistributed(float distance) {
  static const float kLargest =
      std::pow(hybridDistance(huntLabOf({0, 1, 0}), huntLabOf({0, 0, 1})), kColorExponent);
  const float power = std::pow(distance, kColorExponent);
  const float knee = kKneeIn * kLargest;
  if (power < knee) return kKneeOut / knee * power;
  return std::min(1.0f, kKneeOut + (power - knee) / (kLargest - knee) * (1 - kKneeOut));
}

// How strongly each pixel lies on an edge (first derivative of a Gaussian) or on a point (second derivative).
std::vector<float> featuresOf(Plane lightness, bool isPoint, double pixelsPerDegree) {
  const double deviation = 0.5 * kFeatureWidth * pixelsPerDegree;
  const int radius = int(std::ceil(3 * deviation));
  const auto gaussian = [&](double x) { return std::exp(-x * x / (2 * deviation * deviation)); };
  Kernel smooth = kernelOf(radius, gaussian);
  scale(smooth, 1 / sumOf(smooth));
  Kernel derivative = kernelOf(
      radius, [&](double x) { return (isPoint ? x * x / (deviation * deviation) - 1 : -x) * gaussian(x); });
  double positive = 0, negative = 0;
  for (const double weight : derivative) (weight > 0 ? positive : negative) += std::abs(weight);
  for (double& weight : derivative) weight /= weight > 0 ? positive : negative;

  for (float& value : lightness.values) value = (value + 16) / 116;
  const Plane alongX = filtered(lightness, derivative, smooth);
  const Plane alongY = filtered(lightness, smooth, derivative);
  std::vector<float> strengths(alongX.values.size());
  for (std::size_t i = 0; i < strengths.size(); ++i)
    strengths[i] = std::hypot(alongX.values[i], alongY.values[i]);
  return strengths;
}

}  // namespace

std::vector<float> ldrFlip(const ByteImage& reference, const ByteImage& test, double pixelsPerDegree) {
  const std::array<Plane, 3> ofReference = opponentChannels(reference), ofTest = opponentChannels(test);
  const std::vector<vec3> referenceColors = perceivedColors(ofReference, pixelsPerDegree);
  const std::vector<vec3> testColors = perceivedColors(ofTest, pixelsPerDegree);
  std::vector<float> featureDifference(referenceColors.size(), 0);
  for (const bool isPoint : {false, true}) {
    const std::vector<float> a = featuresOf(ofReference[0], isPoint, pixelsPerDegree);
    const std::vector<float> b = featuresOf(ofTest[0], isPoint, pixelsPerDegree);
    for (std::size_t i = 0; i < a.size(); ++i)
      featureDifference[i] = std::max(featureDifference[i], std::abs(a[i] - b[i]));
  }
  std::vector<float> errors(referenceColors.size());
  for (std::size_t i = 0; i < errors.size(); ++i) {
    const float color = redistributed(hybridDistance(referenceColors[i], testColors[i]));
    const float feature = std::pow(featureDifference[i] * glm::one_over_root_two<float>(), kFeatureExponent);
    errors[i] = std::pow(color, 1 - std::min(feature, 1.0f));
  }
  return errors;
}

}  // namespace nephroid
