// Descriptions of what techniques leave out and the reference computes, for `nephroid info` and the reports.
#pragma once

#include <algorithm>
#include <span>

#include "scene/scene.h"

namespace nephroid {

struct Omission {
  const char* what;                      // a sentence's subject: "Shafts of light in the air"
  bool (*concerns)(const Scene& scene);  // whether it matters for a scene
};

// Whether one of a scene's objects has a material that passes the test.
template <class Test>
bool anyMaterial(const Scene& scene, const Test& test) {
  return std::any_of(scene.objects.begin(), scene.objects.end(),
                     [&](const Object& object) { return test(scene.materialOf(object)); });
}

// Whether a scene has ...
bool hasLampWithASize(const Scene& scene);  // and a caster
bool hasCaster(const Scene& scene);
bool hasGlass(const Scene& scene);  // or water
bool hasDispersion(const Scene& scene);
bool hasNearLight(const Scene& scene);     // a caster, and a light that is not infinitely far away
bool hasWaterOrSheet(const Scene& scene);  // water, or sheets too thin to bend light
bool hasScattering(const Scene& scene);    // in water or glass

// Omissions that several techniques have.
namespace omissions {

inline constexpr Omission kReflection{
    "Reflection at glass, outside, inside and total, unless --paths all asks for it, and then most of "
    "what is reflected after the fourth surface at which it could be reflected or transmitted",
    hasGlass};
inline constexpr Omission kSizeOfLamps{
    "The size of lamps: balls and the sun's disk are points, lines and areas are rows of points",
    hasLampWithASize};
inline constexpr Omission kSpectrum{
    "The spectrum: light that disperses goes in three bands, red, green and blue, not by wavelength",
    hasDispersion};
inline constexpr Omission kFarFromMean{
    "Light far from a caster's mean direction: what leaves it at more than 75 degrees from the mean, and "
    "what reaches surfaces that another receiver hides along the mean or that face away from it",
    hasCaster};
inline constexpr Omission kPlaneDetail{
    "Detail between the rays of a caster's vertices, and finer than a texel of the virtual planes",
    hasCaster};
inline constexpr Omission kScattering{"Light that water and glass scatter inside", hasScattering};
// For light volumes, which draw light that water scatters.
inline constexpr Omission kScatteringAside{
    "What glass scatters inside, and what water scatters of light that met no surface before; what water "
    "scatters, where mirrors and other glass show it, and where its surface reflects a part of it",
    hasScattering};

}  // namespace omissions

}  // namespace nephroid
