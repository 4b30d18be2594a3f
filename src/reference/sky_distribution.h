// Directions by how bright a sky is there.
#pragma once

#include <vector>

#include "lights/sky.h"

namespace nephroid {

class SkyDistribution {
 public:
  // `sky` must outlive this. `rotation`: degrees about +y.
  SkyDistribution(const SkyMap& sky, float rotation);

  struct Sample {
    vec3 direction{0};  // unit, the way the light travels
    vec3 weight{0};  // nit over the density of such directions (1/sr): lux on a facing surface, in the mean
  };
  // `u` in [0, 1).
  Sample sample(float u) const;

  vec3 illuminance() const { return sum; }  // lux, were all of it on one facing surface

 private:
  const SkyMap& sky;
  mat3 turned;
  vec3 sum{0};
  std::vector<double> cumulative;  // part of the brightness in a cell and those before it
};

}  // namespace nephroid
