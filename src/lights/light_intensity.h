// How bright a light is in a direction, with its gobo and its profile.
#pragma once

#include "lights/emitters.h"
#include "lights/light_shape.h"
#include "scene/scene.h"

namespace nephroid {

// A light with what its intensity in every direction has in common: made once, asked often. The scene must
// outlive it.
struct ShapedLight {
  Emitter lamp{};  // all of it in one place
  LightFrame frame{};
  const Profile* profile = nullptr;
  const Texture* gobo = nullptr;
  vec2 goboTurn{
      0};  // texels over the tangent of the angle from the axis, times cosine and sine of its rotation

  // Not by its cone alone.
  bool isShaped() const { return profile || gobo; }
};

// For a directional light or a sky, which have no intensity, one without shape.
ShapedLight shapedLight(const Scene& scene, const Light& light);

std::vector<ShapedLight> shapedLights(const Scene& scene);

// Luminous intensity (cd) toward the unit vector `direction`; of the whole tube or panel for a line or an
// area. Cone of KHR_lights_punctual, times gobo, times profile.
vec3 lightIntensity(const ShapedLight& light, vec3 direction);

inline vec3 lightIntensity(const Scene& scene, const Light& light, vec3 direction) {
  return lightIntensity(shapedLight(scene, light), direction);
}

// Illuminance (lux) at `point` on a surface facing the emitter, which is one of `light`.
vec3 illuminance(const ShapedLight& light, const Emitter& emitter, vec3 point);

// As much as lightIntensity gives in any direction: neither cone nor gobo nor profile makes a light brighter.
inline vec3 peakIntensity(const Light& light) {
  return light.intensity;
}

// Part of the peak, 0 to 1, toward `local`: the unit vector's components along right, up and forward.
float profileFraction(const Profile& profile, vec3 local);

// Lumens of the profile by itself, at the peak that it was measured with.
double profileFlux(const Profile& profile);

}  // namespace nephroid
