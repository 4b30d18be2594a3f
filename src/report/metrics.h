// How far an image is from a reference of the same size, in its own linear units. A layer is three channels
// of an image: "" the total, "direct.", "caustics.", ... with R, G, B after it. Where the reference has
// <layer>variance.R,G,B, the variance of its mean, it is known how much of a difference is the reference's
// noise.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"

namespace nephroid {

// Not a number: there is nothing to divide by.
struct LayerErrors {
  double referenceMean = 0;  // nit or lux, over pixels and channels
  double fluxRatio = 0;      // sum of the image over that of the reference
  double relativeRmse = 0;   // root of the mean squared difference, over the reference's mean
  // What relativeRmse would be of an image without any error: the root of the reference's mean variance, over
  // its mean.
  std::optional<double> noiseFloor;
  // Mean over pixels of the sum over channels of |difference|, over the sum over channels of the reference.
  // Only pixels count whose reference is larger than its own standard error: below it, what is divided by is
  // not told from nothing.
  double mape = 0;
  double countedFraction = 0;  // of the pixels, those that count for `mape`
  // Root mean square of difference over standard error, of the values whose standard error is not zero: 1
  // where all the difference is the reference's noise.
  std::optional<double> zScoreRms;
};

// Whether the image has R, G and B of this layer.
bool hasLayer(const Image& image, const std::string& layer);

// Both images have the layer and are of one size.
LayerErrors layerErrors(const Image& reference, const Image& image, const std::string& layer);

// For each pixel the signed difference summed over channels, over the reference's sum; not a number where the
// pixel does not count.
std::vector<float> relativeErrors(const Image& reference, const Image& image, const std::string& layer);

// For each pixel the mean over channels of |difference|, in the image's unit.
std::vector<float> absoluteErrors(const Image& reference, const Image& image, const std::string& layer);

// For each pixel the mean over channels.
std::vector<float> channelMeans(const Image& image, const std::string& layer);

// Some of an image's pixels, those where `chosen` (one for each pixel) is not 0, in a row.
Image pixelsOf(const Image& image, const std::vector<uint8_t>& chosen);

// The value that `fraction` of the values, those that are numbers, do not exceed; 0 of none.
double quantile(std::vector<float> values, double fraction);

}  // namespace nephroid
