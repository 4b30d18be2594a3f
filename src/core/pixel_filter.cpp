#include "core/pixel_filter.h"

#include <array>
#include <cmath>
#include <numbers>

namespace nephroid {
namespace {

// Of the constant and of the cosines.
constexpr std::array<double, 4> kTerms{0.35875, 0.48829, 0.14128, 0.01168};

}  // namespace

double filterWeightBelow(double offset) {
  if (offset <= -kFilterRadius) return 0;
  if (offset >= kFilterRadius) return 1;
  double part = 0.5 + 0.5 * offset / kFilterRadius;
  for (std::size_t k = 1; k < kTerms.size(); ++k) {
    const double frequency = std::numbers::pi * double(k);
    part += kTerms[k] / (2 * kTerms[0] * frequency) * std::sin(frequency * offset / kFilterRadius);
  }
  return part;
}

double filteredOffset(double part) {
  if (part == 0.5) return 0;
  if (part < 0.5) return -filteredOffset(1 - part);
  double low = 0, high = kFilterRadius;
  for (int i = 0; i < 52; ++i) {
    const double middle = 0.5 * (low + high);
    (filterWeightBelow(middle) < part ? low : high) = middle;
  }
  return low;
}

}  // namespace nephroid
