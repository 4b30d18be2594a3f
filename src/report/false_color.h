// Numbers as colours. Errors of a kind have one map wherever they are shown.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "core/image.h"

namespace nephroid {

using SrgbColor = std::array<uint8_t, 3>;

// 0 to 1, held at its ends: from black by purple and orange to light yellow, as bright as large ("magma" of
// matplotlib; a polynomial through it by M. Zucker). Takes what is not a number as 0.
SrgbColor magnitudeColor(float value);

// -1 to 1, held at its ends: blue, white at 0, red (ColorBrewer's "RdBu", linear between its eleven classes);
// apart also to those who do not tell red from green. Grey for what is not a number.
SrgbColor signedColor(float value);
inline constexpr SrgbColor kNoValueColor{128, 128, 128};

// `values` row by row; a value of `bound` has the colour of 1.
ByteImage magnitudeMap(std::span<const float> values, uint32_t width, uint32_t height, double bound);
ByteImage signedMap(std::span<const float> values, uint32_t width, uint32_t height, double bound);

// The next of 1, 2 and 5 times a power of ten that is not below `value`, for the end of a scale; 1 of 0.
double endOfScale(double value);

}  // namespace nephroid
