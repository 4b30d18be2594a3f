// A direction as who looks along a light sees it, and where in a gobo it leads, once for C++ and GLSL.
#ifndef NEPHROID_LIGHTS_LIGHT_SHAPE_H
#define NEPHROID_LIGHTS_LIGHT_SHAPE_H

#include "core/shared_language.h"

SHARED_BEGIN

// Unit axes at a light, for who looks along it.
struct LightFrame {
  vec3 right;
  vec3 up;       // +Y as far as it can be; straight down -Z, straight up +Z
  vec3 forward;  // the light's direction
};

SHARED_FUNCTION LightFrame lightFrame(vec3 direction) {
  LightFrame frame;
  frame.forward = direction;
  float sine = sqrt(direction.x * direction.x + direction.z * direction.z);
  // Near the vertical, as of a light that faces -Z and is tilted there.
  vec3 ahead = sine > 1e-4f ? vec3(direction.x / sine, 0.0f, direction.z / sine) : vec3(0.0f, 0.0f, -1.0f);
  frame.up = normalize(cross(vec3(-ahead.z, 0.0f, ahead.x), direction));
  frame.right = cross(direction, frame.up);
  return frame;
}

// Components of a vector along right, up and forward.
SHARED_FUNCTION vec3 alongFrame(LightFrame frame, vec3 direction) {
  return vec3(dot(direction, frame.right), dot(direction, frame.up), dot(direction, frame.forward));
}

// Where in a gobo light goes, ahead of the light: texels from its middle, right and down. `turn`: texels over
// the tangent of the angle from the axis, times cosine and sine of the image's rotation, clockwise for who
// looks along the light.
SHARED_FUNCTION vec2 placeInGobo(vec2 turn, vec3 local) {
  vec2 place = vec2(local.x, -local.y) / local.z;
  return vec2(place.x * turn.x + place.y * turn.y, place.y * turn.x - place.x * turn.y);
}

SHARED_CONSTANT uint kProfileTypeC = 0u;
SHARED_CONSTANT uint kProfileTypeB = 1u;
SHARED_CONSTANT uint kProfileTypeA = 2u;
SHARED_CONSTANT uint kNoProfile = 3u;

SHARED_END

#endif
