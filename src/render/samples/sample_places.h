// Where the samples of a pixel are.
#pragma once

#include <cstdint>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// The places (pixels, from the middle of each pixel; x to the right, y down) of `count` samples that all
// count the same: the first two dimensions of Sobol's sequence, a (0,2)-sequence (Kollig and Keller 2002),
// moved so that along each axis there is one in the middle of each of `count` equal parts, and spread by the
// pixel filter. One alone is in the middle. The one nearest to the middle is the last: the surfaces that it
// sees stand for the pixel's.
std::vector<vec2> samplePlaces(uint32_t count);

}  // namespace nephroid
