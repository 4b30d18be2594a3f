#include "render/metering.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/color.h"

namespace nephroid {
namespace {

static_assert(unsigned(ToneCurve::neutral) == kToneNeutral && unsigned(ToneCurve::agx) == kToneAgx &&
              unsigned(ToneCurve::aces) == kToneAces && unsigned(ToneCurve::linear) == kToneLinear);

constexpr double kMiddleKey = 0.18;
constexpr double kHighestKey = 0.22;  // which the neutral curve shows as a gray card
constexpr double kClipped = 0.01;     // of the pixels, at each end
constexpr float kSeenStops = 12;      // below the brightest; what is darker has no level of its own

// Of values that are put into another order.
float quantileOf(std::vector<float>& values, double part) {
  const auto place = std::ptrdiff_t(part * double(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + place, values.end());
  return values[std::size_t(place)];
}

// log2 of what is seen at all.
std::vector<float> seenStops(const std::vector<float>& luminances) {
  std::vector<float> stops;
  stops.reserve(luminances.size());
  for (const float luminance : luminances)
    if (luminance > 0 && std::isfinite(luminance)) stops.push_back(std::log2(luminance));
  return stops;
}

}  // namespace

float meteredExposure(const std::vector<float>& luminances) {
  std::vector<float> stops = seenStops(luminances);
  if (stops.empty()) return 1;
  std::vector<float> ordered = stops;
  const float high = quantileOf(ordered, 1 - kClipped);
  const auto isUnseen = [&](float stop) { return stop < high - kSeenStops; };
  std::erase_if(stops, isUnseen);
  std::erase_if(ordered, isUnseen);
  const float low = quantileOf(ordered, kClipped);
  double sum = 0;
  for (const float stop : stops) sum += double(std::clamp(stop, low, high));
  const double average = sum / double(stops.size());
  const double range = double(high - low);
  const double lean = range > 0 ? (2 * average - double(low) - double(high)) / range : 0;  // -1..1
  const double key = std::min(kMiddleKey * std::exp2(lean), kHighestKey);
  return float(std::clamp(key / std::exp2(average), kLeastExposure, kMostExposure));
}

float meteredExposure(const Image& image) {
  const std::vector<float>&red = *image.find("R"), &green = *image.find("G"), &blue = *image.find("B");
  std::vector<float> luminances;
  luminances.reserve(red.size());
  for (std::size_t i = 0; i < red.size(); ++i) luminances.push_back(luminanceOf({red[i], green[i], blue[i]}));
  return meteredExposure(luminances);
}

ToneMapping toneMappingOf(const Camera& camera, const Image& image) {
  return toneMappingOf(camera.exposure ? *camera.exposure : meteredExposure(image), camera.tone);
}

ToneMapping toneMappingOf(float exposure, ToneCurve curve) {
  return {exposure, uint(curve)};
}

}  // namespace nephroid
