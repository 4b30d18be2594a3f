// A pinhole camera: the ray of a place in the picture, and the pixel of a point in the scene.
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

  // Where a point appears, in the picture or `margin` pixels about it, and with which weight. Objects in
  // between are not considered.
  struct Projection {
    vec2 place{0};           // pixels from the upper left corner
    vec3 direction{0};       // unit, from the place to the camera
    float distance = 0;      // m
    float perSteradian = 0;  // 1/sr, 1 over the pixel's solid angle seen from the camera
  };
  std::optional<Projection> project(vec3 place, float margin = 0) const;

  vec3 position() const { return eye_; }
  vec3 forward() const { return frame_[2]; }
  float pixelHeight() const {
    return 2 * height_ / float(size_.y);
  }  // m, height of a pixel at the distance 1 m from the camera

 private:
  vec3 eye_;
  mat3 frame_;            // right, up, forward: unit
  float width_, height_;  // m, half of the picture's size at the distance 1 m
  uvec2 size_;            // pixels
};

}  // namespace nephroid
