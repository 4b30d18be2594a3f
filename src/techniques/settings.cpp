#include "techniques/settings.h"

#include <type_traits>
#include <utility>

#include "irradiance_volume/harmonics.h"

namespace nephroid {
namespace {

template <auto Member>
ChoiceField choice(const char* flag, const char* help, bool isBaked = false) {
  using Choice = std::remove_cvref_t<decltype(std::declval<TechniqueSettings>().*Member)>;
  static constexpr auto kNames = namesOf(Choice{});
  return {flag,
          help,
          kNames,
          [](const TechniqueSettings& settings) { return uint32_t(settings.*Member); },
          [](TechniqueSettings& settings, uint32_t place) { settings.*Member = Choice(place); },
          isBaked};
}

}  // namespace

std::span<const ChoiceField> choiceFields() {
  using Settings = TechniqueSettings;
  static const ChoiceField kFields[] = {
      choice<&Settings::source>(
          "source",
          "Where the rays that leave a caster come from: a light transport table, where smooth glass without "
          "anything in it allows one, or traced now"),
      choice<&Settings::paths>(
          "paths", "Light followed by refraction alone, or by reflection outside and inside as well", true),
      choice<&Settings::interpolation>(
          "interpolation", "Virtual planes that bend onto the receivers, or flat ones that receivers blend"),
      choice<&Settings::culling>(
          "culling",
          "Light volumes found down their hierarchy, or each of them asked for every block of pixels"),
      choice<&Settings::cosine>("cosine",
                                "Between light volumes and receivers: each one's own, or that of the light's "
                                "mean direction, as still water would have it"),
      choice<&Settings::lightInterpolation>(
          "light-interpolation",
          "Between the light directions of an irradiance volume: the nearest, the three around by their "
          "weights, these turned to the light, or moved on from there as the caster moves light"),
      choice<&Settings::representation>(
          "representation",
          "How an irradiance volume is kept: on a uniform grid around the light, on concentric shells "
          "placed where the light changes, on a grid whose bricks are as fine as the light needs, "
          "or as spherical harmonics over light directions",
          true),
  };
  return kFields;
}

std::span<const SettingField> settingFields() {
  using Settings = TechniqueSettings;
  static constexpr SettingField kFields[] = {
      {"planes", "Virtual planes that caustics are drawn on, around the receivers", &Settings::planes, 1, 256,
       "sensor"},
      {"slices",
       "Sample planes across the view: sliced object images of what glass shows (16 at most), and caustics "
       "maps "
       "of sliced-images; 0: as many as the receivers' depth asks for",
       &Settings::slices, 0, 256, nullptr},
      {"texture-size", "Texels along each side of a virtual plane", &Settings::textureSize, 16, 8192,
       nullptr},
      {"directions", "Light directions held for each vertex of a light transport table",
       &Settings::directions, 9, 65535, nullptr, true},
      {"refine-depth", "How many times a beam may be divided where the light within it goes different ways",
       &Settings::refineDepth, 0, 8, nullptr},
      {"volume-kilobytes", "Kilobytes of an irradiance volume for each light direction",
       &Settings::volumeKilobytes, 1, 65535, nullptr, true},
      {"light-level",
       "How often the icosahedron of an irradiance volume's light directions is cut finer: 10 * 4^N + 2 "
       "directions, fewer for symmetric casters",
       &Settings::lightLevel, 0, kMostLightLevels, nullptr, true},
      {"volume-radius",
       "Where an irradiance volume ends, in radii of its caster's bounding sphere; beyond, light goes on as "
       "it left",
       &Settings::volumeRadius, 2, 64, nullptr, true},
      {"volume-photons", "Thousands of photons for each light direction of an irradiance volume",
       &Settings::volumePhotons, 1, 100000, nullptr, true},
      {"harmonic-order", "Order of the spherical harmonics of an irradiance volume kept so",
       &Settings::harmonicOrder, 1, kMostHarmonicOrder, nullptr, true},
      {"volume-error",
       "How far, in thousandths of the light on a caster, the bricks of a multi-resolution irradiance volume "
       "may be off the finest grid, which --volume-kilobytes gives the size of",
       &Settings::volumeError, 0, 1000, nullptr, true},
      {"air-planes",
       "Sampling planes of shafts of light on each ray; 0: as many as --air-error asks for, for each light",
       &Settings::airPlanes, 0, 10000, nullptr},
      {"air-subplanes",
       "Sub-sample planes between two sampling planes, used everywhere; 0: as many as --air-error asks for, "
       "used "
       "where light changes",
       &Settings::airSubplanes, 0, 256, nullptr},
      {"air-error", "Mean error of shafts of light that planes are chosen for, in thousandths of their mean",
       &Settings::airError, 1, 1000, nullptr},
  };
  return kFields;
}

std::span<const PartField> partFields() {
  using Settings = TechniqueSettings;
  static constexpr PartField kFields[] = {
      {"shadow-tolerance",
       "How much of a cell of water may be in the shadow of what stands above before its light is left out; "
       "1: "
       "light is left out in full shadow alone",
       &Settings::shadowTolerance},
      {"contribution-error", "How much of the light may be left out, the weakest light volumes first",
       &Settings::contributionError},
  };
  return kFields;
}

}  // namespace nephroid
