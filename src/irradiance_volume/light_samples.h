// The light directions for which a caster's volume is made, and the interpolation between them.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "irradiance_volume/light_sphere.h"
#include "irradiance_volume/symmetry.h"

namespace nephroid {

// How light between the samples is found. nearest: the sample with the nearest direction. barycentric: the
// weighted mean of the three samples around it. rotated: as barycentric, with each sample turned to the
// light's direction (Wyman 2004, section 5.2, steps A to G). flow: as rotated, with each sample also
// displaced (flow.h).
enum class LightInterpolation { nearest, barycentric, rotated, flow };

// The users' names, in the same order.
inline constexpr std::array<const char*, 4> kLightInterpolationNames{"nearest", "barycentric", "rotated",
                                                                     "flow"};
constexpr const auto& namesOf(LightInterpolation) {
  return kLightInterpolationNames;
}

// One sample and its weight.
struct SampleShare {
  uint32_t sample = 0;
  float weight = 1;
  mat3 toSample{
      1};  // from the caster's own space, before the sample's frame; a rotation, possibly with a mirror
  vec2 aside{0};  // for flow: components of the light's direction across the sample's direction
};

class LightSamples {
 public:
  // A ball needs one direction; a body of revolution those of a quarter circle, or of a half circle where its
  // two ends differ. Other casters need the vertices of a LightSphere that lie on one side of all mirror
  // planes. `level`: of the LightSphere.
  LightSamples(const Symmetry& symmetry, uint32_t level);

  const std::vector<vec3>& directions() const {
    return directions_;
  }  // unit, in the direction in which the light travels
  // rad, about the largest angle between a light and the nearest direction.
  float halfStep() const { return halfStep_; }
  // The samples for light that travels along `direction` (unit, in the caster's own space).
  std::vector<SampleShare> around(vec3 direction, LightInterpolation interpolation) const;

 private:
  std::vector<SampleShare> aroundCircle(vec3 direction) const;
  std::vector<SampleShare> aroundSphere(vec3 direction) const;

  Symmetry symmetry_;
  float halfStep_;
  std::vector<vec3> directions_;
  std::unique_ptr<LightSphere> sphere_;  // only for casters without an axis of revolution
  std::vector<uint32_t> sampleOf_;       // for each of the sphere's vertices, the index of its sample
};

// The frame of a light sample: two columns across the light, and the third along it.
mat3 sampleFrame(vec3 lightDirection);

// The shortest rotation from one unit vector to another.
mat3 turnBetween(vec3 from, vec3 to);

}  // namespace nephroid
