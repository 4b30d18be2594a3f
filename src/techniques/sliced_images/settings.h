#pragma once

#include "core/settings.h"

namespace nephroid {

struct SlicedImageSettings {
  uint32_t slices = 0;  // sample planes across the view; 0: as many as the receivers' depth asks for
  bool operator==(const SlicedImageSettings&) const = default;
};

}  // namespace nephroid
