// Settings of the techniques that draw caustics on virtual planes.
#pragma once

#include <array>

#include "core/settings.h"

namespace nephroid {

// How receivers between virtual planes are lit. surface: planes bend onto the receivers, so that light is
// stored where it arrives. blend: by interpolation between the flat planes before and behind, as in Iwasaki
// 2005b; the result converges as planes are added.
enum class Interpolation { surface, blend };

inline constexpr std::array<const char*, 2> kInterpolationNames{"surface", "blend"};
constexpr const auto& namesOf(Interpolation) {
  return kInterpolationNames;
}

struct PlaneSettings {
  Interpolation interpolation = Interpolation::surface;
  uint32_t textureSize = 512;  // texels along a side of a virtual plane
  bool operator==(const PlaneSettings&) const = default;
};

inline constexpr Setting kPlaneSettings[] = {
    choiceSetting<&PlaneSettings::interpolation>("interpolation",
                                                 "surface: virtual planes that bend onto the receivers; "
                                                 "blend: flat planes, between which receivers interpolate"),
    wholeSetting<&PlaneSettings::textureSize>("texture-size", 16, 8192,
                                              "Texels along each side of a virtual plane"),
};

inline constexpr SettingsOwner kPlaneSettingsOwner =
    settingsOwner<PlaneSettings>("Virtual planes", kPlaneSettings);

}  // namespace nephroid
