// Turns luminance into a picture, with the same tone mapper as for frames.
#pragma once

#include <string>

#include "core/image.h"
#include "render/tone_mapping.h"

namespace nephroid {

// How the fraction of a level becomes whole: by the pattern of what is looked at, or to the nearest level for
// what is measured.
enum class Rounding { dithered, nearest };

// The picture of a layer's R, G and B (nit); "" is the total: exposed, tone-mapped and converted to sRGB, 3
// components. Values that are not numbers become black.
ByteImage pictureOf(const Image& image, const ToneMapping& toneMapping, const std::string& layer = "",
                    Rounding rounding = Rounding::dithered);

}  // namespace nephroid
