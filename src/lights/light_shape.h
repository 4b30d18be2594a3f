// The frame of a light, and where a direction meets its gobo. Written once for C++ and GLSL.
#ifndef NEPHROID_LIGHTS_LIGHT_SHAPE_H
#define NEPHROID_LIGHTS_LIGHT_SHAPE_H

#include "core/shared_language.h"

SHARED_BEGIN

// The unit axes at a light, as seen by someone who looks along it.
struct LightFrame {
  vec3 right;
  vec3 up;       // as near to +Y as possible; -Z for a light that shines straight down, +Z for straight up
  vec3 forward;  // the light's direction
};

SHARED_FUNCTION LightFrame lightFrame(vec3 direction) {
  LightFrame frame;
  frame.forward = direction;
  float sine = sqrt(direction.x * direction.x + direction.z * direction.z);
  // A vertical light has the frame of a light that faces -Z and was tilted.
  vec3 ahead = sine > 1e-4f ? vec3(direction.x / sine, 0.0f, direction.z / sine) : vec3(0.0f, 0.0f, -1.0f);
  frame.up = normalize(cross(vec3(-ahead.z, 0.0f, ahead.x), direction));
  frame.right = cross(direction, frame.up);
  return frame;
}

// Components of a vector along right, up and forward.
SHARED_FUNCTION vec3 alongFrame(LightFrame frame, vec3 direction) {
  return vec3(dot(direction, frame.right), dot(direction, frame.up), dot(direction, frame.forward));
}

// Where light meets a gobo: texels to the right and down from its middle. `local`: components of the light's
// direction in the frame; z must be above 0. `turn`: texels per tangent of the angle from the axis, times the
// cosine and sine of the gobo's rotation, which is clockwise for a viewer who looks along the light.
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
