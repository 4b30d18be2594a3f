// The settings of sliced images.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct SlicedImageSettings {
  uint32_t slices = 0;  // sample planes across the view; 0: a number that fits the receivers' depth
  bool operator==(const SlicedImageSettings&) const = default;
};

}  // namespace nephroid
