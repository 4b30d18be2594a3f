#include "report/false_color.h"

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>

namespace nephroid {
namespace {

using glm::vec3;

SrgbColor bytesOf(vec3 color) {
  const vec3 scaled = glm::round(255.0f * glm::clamp(color, 0.0f, 1.0f));
  return {uint8_t(scaled.r), uint8_t(scaled.g), uint8_t(scaled.b)};
}

template <class Color>
ByteImage mapOf(std::span<const float> values, uint32_t width, uint32_t height, double bound,
                const Color& color) {
  ByteImage map{width, height, 3, {}};
  map.bytes.reserve(3 * values.size());
  for (const float value : values) {
    const SrgbColor bytes = color(float(double(value) / bound));
    map.bytes.insert(map.bytes.end(), bytes.begin(), bytes.end());
  }
  return map;
}

}  // namespace

SrgbColor magnitudeColor(float value) {
  static constexpr std::array<std::array<float, 3>, 7> kPolynomial{{
      {-0.002136485053939582f, -0.000749655052795221f, -0.005386127855323933f},
      {0.2516605407371642f, 0.6775232436837668f, 2.494026599312351f},
      {8.353717279216625f, -3.577719514958484f, 0.3144679030132573f},
      {-27.66873308576866f, 14.26473078096533f, -13.64921318813922f},
      {52.17613981234068f, -27.94360607168351f, 12.94416944238394f},
      {-50.76852536473588f, 29.04658282127291f, 4.23415299384598f},
      {18.65570506591883f, -11.48977351997711f, -5.601961508734096f},
  }};
  const float t = std::isnan(value) ? 0.0f : std::clamp(value, 0.0f, 1.0f);
  vec3 color(0);
  for (auto term = kPolynomial.rbegin(); term != kPolynomial.rend(); ++term)
    color = color * t + vec3((*term)[0], (*term)[1], (*term)[2]);
  return bytesOf(color);
}

SrgbColor signedColor(float value) {
  static constexpr std::array<SrgbColor, 11> kClasses{{{0x05, 0x30, 0x61},
                                                       {0x21, 0x66, 0xac},
                                                       {0x43, 0x93, 0xc3},
                                                       {0x92, 0xc5, 0xde},
                                                       {0xd1, 0xe5, 0xf0},
                                                       {0xf7, 0xf7, 0xf7},
                                                       {0xfd, 0xdb, 0xc7},
                                                       {0xf4, 0xa5, 0x82},
                                                       {0xd6, 0x60, 0x4d},
                                                       {0xb2, 0x18, 0x2b},
                                                       {0x67, 0x00, 0x1f}}};
  if (std::isnan(value)) return kNoValueColor;
  const float place = (std::clamp(value, -1.0f, 1.0f) + 1) * 0.5f * float(kClasses.size() - 1);
  const std::size_t lower = std::min(std::size_t(place), kClasses.size() - 2);
  const auto colorOf = [](const SrgbColor& c) { return vec3(c[0], c[1], c[2]) / 255.0f; };
  return bytesOf(glm::mix(colorOf(kClasses[lower]), colorOf(kClasses[lower + 1]), place - float(lower)));
}

ByteImage magnitudeMap(std::span<const float> values, uint32_t width, uint32_t height, double bound) {
  return mapOf(values, width, height, bound, magnitudeColor);
}

ByteImage signedMap(std::span<const float> values, uint32_t width, uint32_t height, double bound) {
  return mapOf(values, width, height, bound, signedColor);
}

double endOfScale(double value) {
  if (!(value > 0)) return 1;
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double step : {1.0, 2.0, 5.0})
    if (value <= step * power * (1 + 1e-9)) return step * power;
  return 10 * power;
}

}  // namespace nephroid
