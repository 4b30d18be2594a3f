// Turns luminance into a picture, with the same tone mapper as for frames.
#pragma once

#include <string>

#include "core/image.h"

namespace nephroid {

// The picture of a layer's R, G and B (nit); "" is the total. Values are multiplied by `exposure`,
// tone-mapped and converted to sRGB, 3 components. Values that are not numbers become black.
ByteImage pictureOf(const Image& image, float exposure, const std::string& layer = "");

}  // namespace nephroid
