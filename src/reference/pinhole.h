// The camera: which way a place in the picture looks, and where in the picture a place is seen.
#pragma once

#include <optional>

#include "scene/scene.h"
#include "trace/ray_scene.h"

namespace nephroid {

class Pinhole {
 public:
  Pinhole(const Camera& camera, uvec2 pictureSize);

  // `place`: pixels from the upper left corner.
  Ray rayThrough(vec2 place) const;

  // What light that leaves a place counts for in the picture, if nothing is in between.
  struct Projection {
    uint32_t pixel = 0;
    vec3 direction{0};   // unit, from the place to the camera
    float distance = 0;  // m
    float perSteradian =
        0;  // mean over the pixel of what has this much solid angle, seen from the camera: 1/sr
  };
  std::optional<Projection> project(vec3 place) const;

  vec3 position() const { return eye; }
  vec3 forward() const { return frame[2]; }
  float pixelHeight() const { return 2 * height / float(size.y); }  // m, a metre before the camera

 private:
  vec3 eye;
  mat3 frame;           // right, up, forward: unit
  float width, height;  // m, half of the picture a metre before the camera
  uvec2 size;           // pixels
};

}  // namespace nephroid
