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

// How an irradiance volume is kept; as kRepresentation... of irradiance_volume/lookup.h.
enum class Representation { grid, shells, multiResolution, harmonics };

// What users call the enumerators, in their order.
constexpr std::array<const char*, 2> namesOf(Source) {
  return {"table", "traced"};
}
constexpr std::array<const char*, 2> namesOf(Paths) {
  return {"transmission", "all"};
}
constexpr std::array<const char*, 2> namesOf(Interpolation) {
  return {"surface", "blend"};
}
constexpr std::array<const char*, 2> namesOf(Culling) {
  return {"hierarchical", "flat"};
}
constexpr std::array<const char*, 2> namesOf(Cosine) {
  return {"exact", "still-water"};
}
constexpr std::array<const char*, 4> namesOf(LightInterpolation) {
  return {"nearest", "barycentric", "rotated", "flow"};
}
constexpr std::array<const char*, 4> namesOf(Representation) {
  return {"grid", "shells", "multi-resolution", "harmonics"};
}

template <class Choice>
constexpr const char* nameOf(Choice choice) {
  return namesOf(choice)[static_cast<std::size_t>(choice)];
}

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
  float shadowTolerance = 0.65f;  // the part of a cell of water that may be in shadow and still pass light
  float contributionError = 0;    // the part of the light that light volumes may leave out
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
  bool operator==(const TechniqueSettings&) const = default;
};

// A choice among the settings. `flag` is without its dashes; what `nephroid bake` writes depends on it where
// `isBaked`.
struct ChoiceField {
  const char* flag;
  const char* help;
  std::span<const char* const> names;
  uint32_t (*get)(const TechniqueSettings&);  // the place of the name chosen
  void (*set)(TechniqueSettings&, uint32_t);
  bool isBaked = false;
};

std::span<const ChoiceField> choiceFields();

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

// A part of a whole, from 0 to 1, among the settings.
struct PartField {
  const char* flag;  // without its dashes
  const char* help;
  float TechniqueSettings::*member;
};

std::span<const PartField> partFields();

}  // namespace nephroid
