// LDR-FLIP: how much two pictures differ to someone who flips between them (Andersson, Nilsson,
// Akenine-Moller, Oskarsson, Astrom and Fairchild 2020, "FLIP: A Difference Evaluator for Alternating
// Images").
#pragma once

#include <vector>

#include "core/image.h"

namespace nephroid {

// The paper's viewer: 0.7 m from a screen that is 0.7 m and 3840 pixels wide.
inline constexpr double kPixelsPerDegree = 67.0206432765823;

// The difference for each pixel, row by row, from 0 (none) to 1 (the largest). Both pictures are sRGB with 3
// or 4 components (alpha is ignored), and must have the same size.
std::vector<float> ldrFlip(const ByteImage& reference, const ByteImage& test,
                           double pixelsPerDegree = kPixelsPerDegree);

}  // namespace nephroid
