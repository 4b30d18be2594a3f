// Where light comes from: what falls on a point, and photons on their way to the casters.
#pragma once

#include <vector>

#include "core/random.h"
#include "lights/light_intensity.h"
#include "reference/sky_distribution.h"
#include "trace/ray_scene.h"

namespace nephroid {

// A photon where it sets out.
struct EmittedPhoton {
  vec3 origin{0};     // m
  vec3 direction{0};  // unit
  vec3 flux{0};       // lm, were it the only photon
  uint32_t light = 0;
};

// Light that would fall on a point if nothing stood in the way. A sample of it where the light has an extent.
struct Illumination {
  vec3 direction{0};    // unit, the way the light travels
  float distance = 0;   // m; infinite where it comes from afar
  vec3 illuminance{0};  // lux on a facing surface, the air between not counted
};

// casters: only toward what sends light on, so that no photon is spent on light that shadow rays measure
// better. everywhere: all the light there is (of a directional light, all that falls on the scene).
enum class Aim { casters, everywhere };

class Lights {
 public:
  // The scene must outlive this.
  Lights(const Scene& scene, Aim aim);

  uint32_t count() const;
  bool comesFromAfar(uint32_t light) const;
  // `u` in [0, 1): where along a line or on an area, from where of a sky; without meaning for other lights.
  Illumination illumination(uint32_t light, vec3 point, float u) const;
  // The place light comes from, at `u`; without meaning for light from afar.
  vec3 position(uint32_t light, float u) const;

  // A photon: `choice` says of which light and in which direction or place, `along` from where of it; both in
  // [0, 1). Choices spread evenly are photons spread evenly, and neighbouring ones go nearly the same way.
  EmittedPhoton emit(double choice, float along) const;

  // No light can come to a caster.
  bool isDark() const { return shares.empty(); }

 private:
  // A ball, or the cone of a spot light (a ball of no radius).
  struct Target {
    vec3 center{0};
    float radius = 0;     // m; infinite: everywhere
    bool isCone = false;  // the directions of the light's own cone
  };
  // What part of the photons goes from a light to a target.
  struct Share {
    uint32_t light = 0;
    Target target;
    double probability = 0;
    double cumulative = 0;  // with those before it
  };

  void addShares(uint32_t light, const std::vector<Target>& targets);
  EmittedPhoton emitFromAfar(const Share& share, const SkyDistribution::Sample& light, vec2 at) const;
  SkyDistribution::Sample fromAfar(uint32_t light, float u) const;
  EmittedPhoton emitFromPoint(const Share& share, vec3 origin, vec2 at) const;

  const Scene& scene;
  std::vector<ShapedLight> shapes;     // of the lights
  std::vector<SkyDistribution> skies;  // of the lights that are one
  std::vector<uint32_t> skyOfLight;    // of the lights, in `skies`
  vec3 sceneCenter{0};
  float sceneRadius = 0;  // m
  std::vector<Share> shares;
  std::vector<uint32_t> firstShare;  // of each light, and one past the last
};

}  // namespace nephroid
