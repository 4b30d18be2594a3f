// What is left out of what the reference computes, in words for a user: the one list behind `nephroid info`
// and the reports.
#pragma once

#include <span>

#include "scene/scene.h"

namespace nephroid {

struct Omission {
  const char* what;                      // a sentence's subject: "Shafts of light in the air"
  bool (*concerns)(const Scene& scene);  // whether a scene has what it is about
};

// By whatever draws caustics, because of the frame that they are drawn in.
std::span<const Omission> omissionsOfFrame();

// By the techniques, besides.
std::span<const Omission> omissionsOfAutomatic();
std::span<const Omission> omissionsOfIlluminationTextures();
std::span<const Omission> omissionsOfIrradianceVolumes();
std::span<const Omission> omissionsOfSlicedImages();
std::span<const Omission> omissionsOfLightVolumes();
std::span<const Omission> omissionsOfNoCaustics();

}  // namespace nephroid
