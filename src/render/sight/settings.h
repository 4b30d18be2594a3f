// Settings of the view through casters.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct SightSettings {
  uint32_t slices = 0;  // sliced object images of a caster; 0: a number that fits the depth of the receivers
  uint32_t sliceSize = 512;  // texels along a side of one, at least kSurroundingSize
  bool operator==(const SightSettings&) const = default;
};

std::span<const Setting> sightSettings();

}  // namespace nephroid
