// The settings of irradiance volumes.
#pragma once

#include <array>

#include "core/settings.h"
#include "irradiance_volume/light_samples.h"

namespace nephroid {

// How an irradiance volume is stored, in the order of kRepresentation... in irradiance_volume/lookup.h.
enum class Representation { grid, shells, multiResolution, harmonics };

inline constexpr std::array<const char*, 4> kRepresentationNames{"grid", "shells", "multi-resolution",
                                                                 "harmonics"};
constexpr const auto& namesOf(Representation) {
  return kRepresentationNames;
}

struct IrradianceVolumeSettings {
  LightInterpolation lightInterpolation = LightInterpolation::flow;
  Representation representation = Representation::shells;
  uint32_t kilobytes = 360;    // for each light direction
  uint32_t lightLevel = 3;     // how many times the icosahedron of light directions is subdivided
  uint32_t radius = 3;         // bounding radii
  uint32_t photons = 200;      // thousands, for each light direction
  uint32_t harmonicOrder = 5;  // of spherical harmonics over light directions
  uint32_t error = 20;         // thousandths of the light on a caster; only for multi-resolution
  bool operator==(const IrradianceVolumeSettings&) const = default;
};

}  // namespace nephroid
