// The light directions that a caster's volume is made for, and how light from any other is found among them.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "irradiance_volume/light_sphere.h"
#include "irradiance_volume/symmetry.h"

namespace nephroid {

// Between light samples. nearest: the one whose direction is nearest. barycentric: the three around it by
// their weights. rotated: so too, each turned from its direction to the light's (Wyman 2004, section 5.2,
// steps A to G). flow: so too, and moved by what was learnt of the caster (flow.h).
enum class LightInterpolation { nearest, barycentric, rotated, flow };

// What users call them.
inline constexpr std::array<const char*, 4> kLightInterpolationNames{"nearest", "barycentric", "rotated",
                                                                     "flow"};
constexpr const auto& namesOf(LightInterpolation) {
  return kLightInterpolationNames;
}

// A share of one sample.
struct SampleShare {
  uint32_t sample = 0;
  float weight = 1;
  mat3 toSample{1};  // from the caster's own space, without the sample's frame; turns, and may mirror
  vec2 aside{0};     // of flow: across the sample's frame, how far the light is off its direction
};

class LightSamples {
 public:
  // A ball has one direction, a body of revolution those of a quarter circle (a half one where its ends
  // differ), all others the vertices of a LightSphere that no mirror plane has on its other side.
  LightSamples(const Symmetry& symmetry, uint32_t level);

  const std::vector<vec3>& directions() const { return directions_; }  // unit, the way the light travels
  // rad, that light is off the nearest direction at most, or nearly so.
  float halfStep() const { return halfStep_; }
  // For light that travels along the unit vector `direction`, in the caster's own space.
  std::vector<SampleShare> around(vec3 direction, LightInterpolation interpolation) const;

 private:
  std::vector<SampleShare> aroundCircle(vec3 direction) const;
  std::vector<SampleShare> aroundSphere(vec3 direction) const;

  Symmetry symmetry_;
  float halfStep_;
  std::vector<vec3> directions_;
  std::unique_ptr<LightSphere> sphere_;  // of the third kind alone
  std::vector<uint32_t> sampleOf_;       // of each of its vertices
};

// The columns span the space of a light sample: across the light, and along it.
mat3 sampleFrame(vec3 lightDirection);

// The shortest turn from one unit vector to another.
mat3 turnBetween(vec3 from, vec3 to);

}  // namespace nephroid
