#pragma once

#include <array>

#include "core/settings.h"

namespace nephroid {

// How light volumes are found for a block of pixels: down their hierarchy, or each of them asked.
enum class Culling { hierarchical, flat };

inline constexpr std::array<const char*, 2> kCullingNames{"hierarchical", "flat"};
constexpr const auto& namesOf(Culling) {
  return kCullingNames;
}

// The cosine between a light volume and a receiver's normal: each volume's own, or that of the light's mean
// direction, which through still water is that of all of it (Barczak and Olano, 3.2).
enum class Cosine { exact, stillWater };

inline constexpr std::array<const char*, 2> kCosineNames{"exact", "still-water"};
constexpr const auto& namesOf(Cosine) {
  return kCosineNames;
}

struct LightVolumeSettings {
  Culling culling = Culling::hierarchical;
  Cosine cosine = Cosine::exact;
  float contributionError = 0;  // the part of the light that light volumes may leave out
  uint32_t detail = 512;  // texels along each side of the planes on which it is judged whether a volume bends
  bool operator==(const LightVolumeSettings&) const = default;
};

}  // namespace nephroid
