// Samples the directions of a sky by their brightness.
#pragma once

#include <vector>

#include "lights/sky.h"

namespace nephroid {

class SkyDistribution {
 public:
  // `sky` must outlive this. `rotation`: degrees about +y.
  SkyDistribution(const SkyMap& sky, float rotation);

  struct Sample {
    vec3 direction{0};  // unit, in which the light travels
    vec3 weight{0};  // luminance (nit) divided by the density of directions (1/sr): lux on a facing surface,
                     // in the mean
  };
  // `u` in [0, 1).
  Sample sample(float u) const;

  vec3 illuminance() const { return sum_; }  // lux, the sum for surfaces that face each part

 private:
  const SkyMap& sky_;
  mat3 turned_;
  vec3 sum_{0};
  std::vector<double> cumulative_;  // the part of the brightness in this cell and all cells before it
};

}  // namespace nephroid
