// Colors in linear Rec. 709.
#pragma once

#include "core/shared_language.h"

namespace nephroid {

// The luminance of a color, in the unit of its channels.
inline float luminanceOf(vec3 color) {
  return dot(color, vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace nephroid
