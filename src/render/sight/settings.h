// Settings of the view through casters.
#pragma once

#include "core/settings.h"

namespace nephroid {

struct SightSettings {
  uint32_t slices = 0;  // sliced object images of a caster; 0: as many as the depth of the receivers asks for
  uint32_t sliceSize = 512;  // texels along a side of one, at least kSurroundingSize
  bool operator==(const SightSettings&) const = default;
};

std::span<const Setting> sightSettings();

}  // namespace nephroid
