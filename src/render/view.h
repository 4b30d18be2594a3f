// The camera for the passes.
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
  float pixelAngle;  // radians between neighboring pixels, in the middle of the picture
  vec2 shift{0};     // in clip space, of what is seen: 0 where pixels are seen by their middles
};

// The upward direction of a camera that looks along `forward` (unit); not necessarily perpendicular to it.
vec3 uprightFor(const Camera& camera, vec3 forward);

// The view of a camera. `size`: pixels. The far end is infinite; the near end is a ten-thousandth of the
// distance to the target.
View viewOf(const Camera& camera, uvec2 size);

// The same view with each pixel seen at `place` (pixels, from its middle; x to the right, y down). `view` has
// no shift.
View viewAt(const View& view, vec2 place, uvec2 size);

// The view ray at the place (x, y) of clip space has the direction middle + x * right + y * down, whose
// component along the camera's axis is 1.
struct PictureRays {
  vec3 middle, right, down;
};
PictureRays raysOf(const View& view);

// The pixels that a box with these corners (m, world space) may cover. Its size is 0 where there are none.
gpu::Region regionOf(const View& view, uvec2 size, const std::array<vec3, 8>& corners);

// The smallest region that holds both.
gpu::Region unionOf(const gpu::Region& a, const gpu::Region& b);

}  // namespace nephroid
