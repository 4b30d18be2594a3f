// Linear Rec. 709.
#pragma once

#include "core/shared_language.h"

namespace nephroid {

// How bright a color is, in the unit that its channels are in.
inline float luminanceOf(vec3 color) {
  return dot(color, vec3(0.2126f, 0.7152f, 0.0722f));
}

}  // namespace nephroid
