// Everything a user may choose about how caustics and shafts of light are made. The member initialisers are
// the defaults; the lists below give each its flag, range and help, so that the command line is made from
// them.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

#include "irradiance_volume/light_samples.h"
#include "transport/source.h"

namespace nephroid {

enum class Source { table, traced };

// How a receiver between virtual planes is lit. surface: planes bend onto the receivers, so that light is
// left where it arrives. blend: from the flat planes before and behind it, as Iwasaki 2005b does; converges
// as planes are added.
enum class Interpolation { surface, blend };

// How light volumes are found for a block of pixels: down their hierarchy, or each of them asked.
enum class Culling { hierarchical, flat };

// The cosine between a light volume and a receiver's normal: each volume's own, or that of the light's mean
// direction, which through still water is that of all of it (Barczak and Olano, 3.2).
enum class Cosine { exact, stillWater };

// In the order of the enumerators.
inline constexpr std::array<const char*, 2> kSourceNames{"table", "traced"};
inline constexpr std::array<const char*, 2> kPathsNames{"transmission", "all"};
inline constexpr std::array<const char*, 2> kInterpolationNames{"surface", "blend"};
inline constexpr std::array<const char*, 2> kCullingNames{"hierarchical", "flat"};
inline constexpr std::array<const char*, 2> kCosineNames{"exact", "still-water"};
inline constexpr std::array<const char*, 4> kLightInterpolationNames{"nearest", "barycentric", "rotated",
                                                                     "flow"};

// How an irradiance volume is kept; as kRepresentation... of irradiance_volume/lookup.h.
enum class Representation { grid, shells, multiResolution, harmonics };
inline constexpr std::array<const char*, 4> kRepresentationNames{"grid", "shells", "multi-resolution",
                                                                 "harmonics"};

struct TechniqueSettings {
  std::string technique = "automatic";  // a name of the registry
  Source source = Source::table;
  Paths paths = Paths::transmission;
  Interpolation interpolation = Interpolation::surface;
  uint32_t planes = 4;          // virtual planes; 0: a single one, in the sensor's own plane
  uint32_t slices = 0;          // sample planes across the view; 0: as many as receivers' depth asks for
  uint32_t textureSize = 512;   // texels along a side of a virtual plane
  uint32_t directions = 129;    // per vertex of a light transport table
  std::filesystem::path baked;  // the tables or volumes to use; empty: found in the cache, or made
  uint32_t refineDepth = 2;     // times a beam may be halved along its edges
  Culling culling = Culling::hierarchical;
  Cosine cosine = Cosine::exact;
  LightInterpolation lightInterpolation = LightInterpolation::flow;
  Representation representation = Representation::shells;
  uint32_t volumeKilobytes = 360;  // of an irradiance volume, for each light direction
  uint32_t lightLevel = 3;         // times the icosahedron of light directions is cut finer
  uint32_t volumeRadius = 3;       // bounding radii
  uint32_t volumePhotons = 200;    // thousands, for each light direction
  uint32_t harmonicOrder = 5;      // of spherical harmonics over light directions
  uint32_t volumeError = 20;       // thousandths of the light on a caster; multi-resolution alone
  uint32_t airPlanes = 0;          // sampling planes of shafts; 0: as many as airError asks for
  uint32_t airSubplanes = 0;       // sub-sample planes of each; 0: as many as airError asks for
  uint32_t airError = 4;           // thousandths of shafts' mean luminance
};

inline const char* nameOf(Source source) {
  return kSourceNames[static_cast<std::size_t>(source)];
}
inline const char* nameOf(Paths paths) {
  return kPathsNames[static_cast<std::size_t>(paths)];
}
inline const char* nameOf(Interpolation interpolation) {
  return kInterpolationNames[static_cast<std::size_t>(interpolation)];
}

inline const char* nameOf(Culling culling) {
  return kCullingNames[static_cast<std::size_t>(culling)];
}
inline const char* nameOf(Cosine cosine) {
  return kCosineNames[static_cast<std::size_t>(cosine)];
}
inline const char* nameOf(Representation representation) {
  return kRepresentationNames[static_cast<std::size_t>(representation)];
}
inline const char* nameOf(LightInterpolation interpolation) {
  return kLightInterpolationNames[static_cast<std::size_t>(interpolation)];
}

// A number among the settings.
struct SettingField {
  const char* flag;  // without its dashes
  const char* help;
  uint32_t TechniqueSettings::*member;
  uint32_t minimum;
  uint32_t maximum;
  const char*
      zeroWord;  // what a user writes for 0 where a sensor is measured; null where there is no such word
  bool isBaked = false;  // what `nephroid bake` writes depends on it
};

std::span<const SettingField> settingFields();

}  // namespace nephroid
