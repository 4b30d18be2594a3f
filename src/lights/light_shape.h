// What gobos and photometric profiles ask of a direction, once for C++ and GLSL.
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

// First and last of the angles of a profile, in degrees.
struct ProfileRange {
  vec2 vertical;
  vec2 horizontal;
};

// An angle of type C around the light, 0 to 360, as the file has it by symmetry.
SHARED_FUNCTION float foldedAround(vec2 range, float horizontal) {
  if (range.x == 90.0f && range.y == 270.0f) {
    if (horizontal < 90.0f) return 180.0f - horizontal;
    return horizontal > 270.0f ? 540.0f - horizontal : horizontal;
  }
  if (range.y <= 180.0f && horizontal > 180.0f) horizontal = 360.0f - horizontal;
  if (range.y <= 90.0f && horizontal > 90.0f) horizontal = 180.0f - horizontal;
  return horizontal;
}

// An angle of type A or B as the file has it by symmetry.
SHARED_FUNCTION float foldedAside(vec2 range, float angle) {
  return range.x == 0.0f ? abs(angle) : angle;
}

// Vertical and horizontal angle (degrees) of a unit vector given along the light's frame. Types as in
// PhotometryType.
SHARED_FUNCTION vec2 profileAngles(uint type, ProfileRange range, vec3 local) {
  if (type == kProfileTypeC) {
    float vertical = degrees(atan(sqrt(local.x * local.x + local.y * local.y), local.z));
    if (range.horizontal.x == range.horizontal.y) return vec2(vertical, range.horizontal.x);
    float around = degrees(atan(-local.x, local.y));
    return vec2(vertical, foldedAround(range.horizontal, around < 0.0f ? around + 360.0f : around));
  }
  bool isTypeA = type == kProfileTypeA;
  float latitude = degrees(asin(clamp(isTypeA ? local.y : local.x, -1.0f, 1.0f)));
  float longitude = degrees(atan(isTypeA ? local.x : local.y, local.z));
  return vec2(foldedAside(range.vertical, isTypeA ? latitude : longitude),
              foldedAside(range.horizontal, isTypeA ? longitude : latitude));
}

// Whether the profile is not dark there by definition. Around a light of type C all horizontal angles are in
// the file, by symmetry.
SHARED_FUNCTION bool profileHolds(uint type, ProfileRange range, vec2 angles) {
  if (angles.x < range.vertical.x || angles.x > range.vertical.y) return false;
  return type == kProfileTypeC || (angles.y >= range.horizontal.x && angles.y <= range.horizontal.y);
}

// Where `angle` comes among `count` angles (two or more) if they are evenly spaced, as most are: the lower of
// its neighbours.
SHARED_FUNCTION int lowerAngle(vec2 range, int count, float angle) {
  return clamp(int((angle - range.x) / (range.y - range.x) * float(count - 1)), 0, count - 2);
}

SHARED_END

#endif
