// How bright a light is in a direction, with its gobo and its profile.
#pragma once

#include "lights/emitters.h"
#include "lights/light_shape.h"
#include "scene/scene.h"

namespace nephroid {

// A light prepared for many evaluations of its intensity. The scene must outlive it.
struct ShapedLight {
  Emitter lamp{};  // the light as a single emitter
  LightFrame frame{};
  const Profile* profile = nullptr;
  const Texture* gobo = nullptr;
  vec2 goboTurn{0};  // as in placeInGobo

  // Whether it has a profile or a gobo.
  bool isShaped() const { return profile || gobo; }
};

// For a directional light or a sky, which have no intensity, the result has no shape.
ShapedLight shapedLight(const Scene& scene, const Light& light);

std::vector<ShapedLight> shapedLights(const Scene& scene);

// Luminous intensity (cd) toward the unit vector `direction`; of the whole tube or panel for a line or an
// area. Cone of KHR_lights_punctual, times gobo, times profile.
vec3 lightIntensity(const ShapedLight& light, vec3 direction);

inline vec3 lightIntensity(const Scene& scene, const Light& light, vec3 direction) {
  return lightIntensity(shapedLight(scene, light), direction);
}

// Illuminance (lux) at `point` (m) on a surface that faces the emitter. The emitter is one of `light`.
vec3 illuminance(const ShapedLight& light, const Emitter& emitter, vec3 point);

// An upper bound (cd) of lightIntensity over all directions: cone, gobo and profile never make a light
// brighter.
inline vec3 peakIntensity(const Light& light) {
  return light.intensity;
}

// The part (0..1) of the peak toward a direction. `local`: its components along right, up and forward; unit.
float profileFraction(const Profile& profile, vec3 local);

// The flux (lm) of a light with this profile and the profile's own peak.
double profileFlux(const Profile& profile);

}  // namespace nephroid
