// Settings of the view through casters.
#pragma once

#include <array>

#include "core/settings.h"

namespace nephroid {

// How the view through casters is found: by rays for each pixel, or by the sliced object images of papers 1
// and 2.
enum class SightMethod { rays, slices };

inline constexpr std::array<const char*, 2> kSightMethodNames{"rays", "slices"};
constexpr const auto& namesOf(SightMethod) {
  return kSightMethodNames;
}

struct SightSettings {
  SightMethod method = SightMethod::rays;
  uint32_t slices = 0;  // sliced object images of a caster; 0: a number that fits the depth of the receivers
  uint32_t sliceSize = 512;  // texels along a side of one, at least kSurroundingSize
  bool operator==(const SightSettings&) const = default;
};

std::span<const Setting> sightSettings();

}  // namespace nephroid
