// Color maps for numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/image.h"

namespace nephroid {

using SrgbColor = std::array<uint8_t, 3>;

// The color of a value from 0 to 1: from black through purple and orange to light yellow; larger values are
// brighter ("magma" of matplotlib, as a polynomial by M. Zucker). Values outside are clamped; NaN counts as
// 0.
SrgbColor magnitudeColor(float value);

// The color of a value from -1 to 1: blue, white at 0, red (ColorBrewer's "RdBu", linear between its eleven
// classes), which also color-blind readers can tell apart. Values outside are clamped; NaN is gray.
SrgbColor signedColor(float value);
inline constexpr SrgbColor kNoValueColor{128, 128, 128};

// A map of `values` (row by row); the value `bound` has the color of 1.
ByteImage magnitudeMap(std::span<const float> values, uint32_t width, uint32_t height, double bound);
ByteImage signedMap(std::span<const float> values, uint32_t width, uint32_t height, double bound);

// A round number for the end of a scale: the smallest 1, 2 or 5 times a power of ten that is not below
// `value`; 1 for 0.
double endOfScale(double value);

}  // namespace nephroid
