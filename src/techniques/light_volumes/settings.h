// The settings of light volumes.
#pragma once

#include <array>

#include "core/settings.h"

namespace nephroid {

// How the light volumes of a block of pixels are found: by their hierarchy, or by a test of each.
enum class Culling { hierarchical, flat };

inline constexpr std::array<const char*, 2> kCullingNames{"hierarchical", "flat"};
constexpr const auto& namesOf(Culling) {
  return kCullingNames;
}

// The cosine between a light volume and a receiver's normal. exact: for each volume. stillWater: for the
// light's mean direction, which is right for all light through still water (Barczak and Olano, 3.2).
enum class Cosine { exact, stillWater };

inline constexpr std::array<const char*, 2> kCosineNames{"exact", "still-water"};
constexpr const auto& namesOf(Cosine) {
  return kCosineNames;
}

struct LightVolumeSettings {
  Culling culling = Culling::hierarchical;
  Cosine cosine = Cosine::exact;
  float contributionError = 0;  // 0..1, the part of the light that may be left out
  uint32_t detail = 512;  // texels along each side of the planes on which it is tested whether a volume bends
  bool operator==(const LightVolumeSettings&) const = default;
};

}  // namespace nephroid
