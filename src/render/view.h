// The camera as passes are told of it.
#pragma once

#include <array>
#include <span>

#include "gpu/command_list.h"
#include "scene/scene.h"

namespace nephroid {

// A pinhole camera. World space.
struct View {
  mat4 worldToClip;  // y down; depth is `nearest` over the distance along `forward`
  vec3 eye;          // m
  vec3 forward;      // unit
  float nearest;     // m
  float pixelAngle;  // radians between neighbouring pixels, in the middle of the picture
};

// What a camera that looks along `forward` (unit) has above it; not necessarily across the view.
vec3 uprightFor(const Camera& camera, vec3 forward);

// Sees infinitely far, and as near as a ten-thousandth of the distance to what is looked at.
View viewOf(const Camera& camera, uvec2 size);

// A ray of sight at the place (x, y) of clip space goes along middle + x * right + y * down, whose part along
// the view is 1.
struct PictureRays {
  vec3 middle, right, down;
};
PictureRays raysOf(const View& view);

// The pixels that a box with these corners (m, world space) may cover; of no size where there are none.
gpu::Region regionOf(const View& view, uvec2 size, const std::array<vec3, 8>& corners);

// The smallest that holds both.
gpu::Region unionOf(const gpu::Region& a, const gpu::Region& b);

}  // namespace nephroid
