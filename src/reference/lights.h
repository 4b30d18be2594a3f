// Samples lights: the light that falls on a point, and photons toward the casters.
#pragma once

#include <vector>

#include "core/random.h"
#include "lights/lamp_light.h"
#include "reference/sky_distribution.h"
#include "trace/ray_scene.h"

namespace nephroid {

// A photon at its start.
struct EmittedPhoton {
  vec3 origin{0};     // m
  vec3 direction{0};  // unit
  vec3 flux{0};       // lm, to be divided by the number of photons
  uint32_t light = 0;
};

// Where photons are sent. casters: only toward casters, because shadow rays are better for all other light.
// everywhere: in all directions (for a directional light: over the whole scene).
enum class Aim { casters, everywhere };

class Lights {
 public:
  // The scene must outlive this.
  Lights(const Scene& scene, Aim aim);

  uint32_t count() const;
  bool comesFromAfar(uint32_t light) const;
  // `u` in [0, 1): chooses the place on a light with a size; not used for other lights.
  Illumination illumination(uint32_t light, vec3 point, float u) const;
  // The place (m) of the light at `u`, of a ball its middle; without meaning for light from afar.
  vec3 position(uint32_t light, float u) const;
  // m about the middle of a light.
  float extent(uint32_t light) const { return extentOf(scene_.lights[light]); }
  // Whether a caster may reach into the light, so that its photons do not all set out in the same medium.
  bool meetsCaster(uint32_t light) const { return meetsCaster_[light]; }

  // Makes a photon from two numbers in [0, 1). `choice` selects the light and the direction, `along` the
  // place on the light. Evenly spread choices give evenly spread photons, and neighboring choices give
  // similar photons.
  EmittedPhoton emit(double choice, float along) const;

  // Whether no light can come to a caster.
  bool isDark() const { return shares_.empty(); }

 private:
  // A ball, or the cone of a spot light (a ball of no radius).
  struct Target {
    vec3 center{0};
    float radius = 0;     // m; infinite: everywhere
    bool isCone = false;  // the target is the light's own cone of directions
  };
  // The part of the photons that goes from a light to a target.
  struct Share {
    uint32_t light = 0;
    Target target;
    double probability = 0;
    double cumulative = 0;  // the sum of its probability and of those before it
  };

  void addShares(uint32_t light, const std::vector<Target>& targets);
  EmittedPhoton emitFromAfar(const Share& share, const SkyDistribution::Sample& light, vec2 at) const;
  SkyDistribution::Sample fromAfar(uint32_t light, float u) const;
  EmittedPhoton emitFromNear(const Share& share, vec2 place, vec2 at) const;
  float targetWidth(const Light& light, vec3 origin, const Target& target) const;

  const Scene& scene_;
  std::vector<ShapedLight> shapes_;     // of the lights
  std::vector<SkyDistribution> skies_;  // of the lights that are one
  std::vector<uint32_t> skyOfLight_;    // of the lights, in `skies`
  std::vector<bool> meetsCaster_;       // of the lights
  vec3 sceneCenter_{0};
  float sceneRadius_ = 0;  // m
  std::vector<Share> shares_;
  std::vector<uint32_t> firstShare_;  // of each light, and one past the last
};

}  // namespace nephroid
