// How bright a light is in a direction: the one answer behind every technique that knows gobos and profiles.
#pragma once

#include "scene/emitters.h"
#include "scene/scene.h"

namespace nephroid {

// Unit axes at a light, for who looks along it.
struct LightFrame {
  vec3 right;
  vec3 up;       // +Y as far as it can be; straight down -Z, straight up +Z
  vec3 forward;  // the light's direction
};

LightFrame lightFrame(vec3 direction);

// A light with what its intensity in every direction has in common: made once, asked often. The scene must
// outlive it.
struct ShapedLight {
  vec3 intensity{0};  // cd, at the peak
  SpotCone cone;
  LightFrame frame{};
  const Profile* profile = nullptr;
  const Texture* gobo = nullptr;
  float goboScale = 0;  // texels over the tangent of the angle from the axis
};

// Of a point, spot or line light.
ShapedLight shapedLight(const Scene& scene, const Light& light);

// Luminous intensity (cd) toward the unit vector `direction`; of the whole tube for a line. Cone of
// KHR_lights_punctual, times gobo, times profile.
vec3 lightIntensity(const ShapedLight& light, vec3 direction);

inline vec3 lightIntensity(const Scene& scene, const Light& light, vec3 direction) {
  return lightIntensity(shapedLight(scene, light), direction);
}

// As much as lightIntensity gives in any direction: neither cone nor gobo nor profile makes a light brighter.
inline vec3 peakIntensity(const Light& light) {
  return light.intensity;
}

// Part of the peak, 0 to 1, toward `local`: the unit vector's components along right, up and forward.
float profileFraction(const Profile& profile, vec3 local);

// Lumens of the profile by itself, at the peak that it was measured with.
double profileFlux(const Profile& profile);

// What of a light only the reference technique draws, as a sentence that names it; empty for nothing.
std::string whyNotDrawable(const Light& light);

// Throws InputError where there is such a light.
void requireDrawableLights(const Scene& scene);

}  // namespace nephroid
