// Luminance as a picture, by the tone mapper that frames are drawn with.
#pragma once

#include <string>

#include "core/image.h"

namespace nephroid {

// The R, G and B (nit) of a layer, "" for the total: multiplied by `exposure`, tone-mapped, sRGB, RGB. What
// is not a number is black.
ByteImage pictureOf(const Image& image, float exposure, const std::string& layer = "");

}  // namespace nephroid
