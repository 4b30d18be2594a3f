// Errors of an image against a reference of the same size, in the linear units of the images. A layer is
// three channels R, G, B of an image with a common prefix: "" is the total, then "direct.", "caustics." and
// others. If the reference has <layer>variance.R,G,B (the variance of its mean), its noise is known.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/image.h"

namespace nephroid {

// A value is NaN where the divisor is 0.
struct LayerErrors {
  double referenceMean = 0;  // nit or lux, over pixels and channels
  double fluxRatio = 0;      // sum of the image over that of the reference
  double relativeRmse = 0;   // root of the mean squared difference, over the reference's mean
  // The relativeRmse of an image without any error: the square root of the reference's mean variance, over
  // its mean.
  std::optional<double> noiseFloor;
  // Mean over pixels of the sum over channels of |difference|, over the sum over channels of the reference.
  // Only pixels count whose reference is larger than its own standard error; below, the divisor may be only
  // noise.
  double mape = 0;
  double countedFraction = 0;  // the part (0..1) of the pixels that count for `mape`
  // The root mean square of difference over standard error, for values whose standard error is not zero.
  // About 1 where the whole difference is noise of the reference.
  std::optional<double> zScoreRms;
};

// Whether the image has R, G and B of this layer.
bool hasLayer(const Image& image, const std::string& layer);

// Both images have the layer and are of one size.
LayerErrors layerErrors(const Image& reference, const Image& image, const std::string& layer);

// For each pixel: the signed difference, summed over channels, divided by the reference's sum. NaN where the
// pixel does not count.
std::vector<float> relativeErrors(const Image& reference, const Image& image, const std::string& layer);

// For each pixel the mean over channels of |difference|, in the image's unit.
std::vector<float> absoluteErrors(const Image& reference, const Image& image, const std::string& layer);

// For each pixel the mean over channels.
std::vector<float> channelMeans(const Image& image, const std::string& layer);

// The pixels of an image where `chosen` (one value for each pixel) is not 0, as an image with one row.
Image pixelsOf(const Image& image, const std::vector<uint8_t>& chosen);

// The value that the part `fraction` (0..1) of the values does not exceed, without NaNs; 0 for an empty list.
double quantile(std::vector<float> values, double fraction);

}  // namespace nephroid
