// The filter by which a picture's pixels weigh the light around their middles.
#pragma once

namespace nephroid {

// The Blackman-Harris window (Harris 1978, the minimum of four terms) along each axis, as wide as Blender
// Cycles has it by default.
inline constexpr double kFilterRadius = 1.5;  // pixels

// The variance (pixels squared) of a place along an axis that is chosen by the filter.
inline constexpr double kFilterVariance = 0.17265848;

// The weight of a place (1/pixel along an axis) `offset` pixels from the pixel's middle.
double filterDensity(double offset);

// The part of the filter's weight below `offset` (pixels from the pixel's middle, along an axis).
double filterWeightBelow(double offset);

// The offset (pixels) below which `part` (0 to 1) of the weight is: places that are spread evenly over 0 to 1
// become places that all count the same (filter importance sampling, Ernst 2006). 0 for a half, exactly.
double filteredOffset(double part);

// The same by a table, within 1e-4 pixels, for places by the million.
float quickFilteredOffset(float part);

}  // namespace nephroid
