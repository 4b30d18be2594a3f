// How much light of lamps with a size falls on a sensor's texel, with shadows as soft as the lamps are large.
#pragma once

#include <vector>

#include "lights/lamp_light.h"
#include "scene/scene.h"
#include "trace/ray_scene.h"

namespace nephroid {

class LampExposure {
 public:
  // All must outlive this. `error`: of a texel's light, at most, over what it has without shadows.
  LampExposure(const Scene& scene, const RayScene& rays, const Sensor& sensor, float error);

  bool isAny() const { return !lamps_.empty(); }

  // lux, the mean over the texel. The same at each call.
  vec3 onTexel(uvec2 texel) const;

 private:
  struct Lamp {
    const Light* light;
    ShapedLight shaped;
  };
  vec3 ofLamp(const Lamp& lamp, uvec2 texel, uint32_t seed) const;

  const Scene& scene_;
  const RayScene& rays_;
  const Sensor& sensor_;
  const float error_;
  std::vector<Lamp> lamps_;
};

}  // namespace nephroid
