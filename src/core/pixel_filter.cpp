#include "core/pixel_filter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace nephroid {
namespace {

// Of the constant and of the cosines.
constexpr std::array<double, 4> kTerms{0.35875, 0.48829, 0.14128, 0.01168};

constexpr std::size_t kTableParts = 4096;

std::array<float, kTableParts + 1> offsetTable() {
  std::array<float, kTableParts + 1> table{};
  for (std::size_t i = 0; i <= kTableParts; ++i)
    table[i] = float(filteredOffset(double(i) / double(kTableParts)));
  return table;
}

}  // namespace

double filterDensity(double offset) {
  if (std::abs(offset) >= kFilterRadius) return 0;
  double sum = kTerms[0];
  for (std::size_t k = 1; k < kTerms.size(); ++k)
    sum += kTerms[k] * std::cos(std::numbers::pi * double(k) * offset / kFilterRadius);
  return sum / (2 * kTerms[0] * kFilterRadius);
}

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

float quickFilteredOffset(float part) {
  static const std::array<float, kTableParts + 1> kTable = offsetTable();
  // It is steep in its tails.
  constexpr float kTail = 0.004f;
  if (part < kTail || part > 1 - kTail) return float(filteredOffset(double(std::clamp(part, 0.0f, 1.0f))));
  const float place = std::clamp(part, 0.0f, 1.0f) * float(kTableParts);
  const std::size_t first = std::min(std::size_t(place), kTableParts - 1);
  return std::lerp(kTable[first], kTable[first + 1], place - float(first));
}

}  // namespace nephroid
