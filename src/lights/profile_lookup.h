// Looks up a photometric profile (IES LM-63). Written once for C++ and GLSL.
//
// A shader defines these before it includes this file; C++ has them below:
//
//   struct ProfileView        with `uint type` (kProfileType...) and `ivec2 counts`, the numbers of vertical
//                             and horizontal angles
//   float verticalAngle(ProfileView profile, int i)     degrees, ascending
//   float horizontalAngle(ProfileView profile, int i)   degrees, ascending
//   float profileValue(ProfileView profile, ivec2 at)   the part (0..1) of the peak at the angles number at.x
//                                                       (vertical) and at.y (horizontal)
#ifndef NEPHROID_LIGHTS_PROFILE_LOOKUP_H
#define NEPHROID_LIGHTS_PROFILE_LOOKUP_H

#include "core/shared_language.h"

#ifdef __cplusplus
namespace nephroid {
struct ProfileView {
  uint type;
  ivec2 counts;
  const float* verticalAngles;
  const float* horizontalAngles;
  const float* values;  // [horizontal * counts.x + vertical]
};
inline float verticalAngle(const ProfileView& profile, int i) {
  return profile.verticalAngles[i];
}
inline float horizontalAngle(const ProfileView& profile, int i) {
  return profile.horizontalAngles[i];
}
inline float profileValue(const ProfileView& profile, ivec2 at) {
  return profile.values[at.y * profile.counts.x + at.x];
}
}  // namespace nephroid
#endif

SHARED_BEGIN

// The first (x) and last (y) angles of a profile, in degrees.
struct ProfileRange {
  vec2 vertical;
  vec2 horizontal;
};

// Maps a horizontal angle of type C (0..360 degrees) by symmetry to an angle of the file.
SHARED_FUNCTION float foldedAround(vec2 range, float horizontal) {
  if (range.x == 90.0f && range.y == 270.0f) {
    if (horizontal < 90.0f) return 180.0f - horizontal;
    return horizontal > 270.0f ? 540.0f - horizontal : horizontal;
  }
  if (range.y <= 180.0f && horizontal > 180.0f) horizontal = 360.0f - horizontal;
  if (range.y <= 90.0f && horizontal > 90.0f) horizontal = 180.0f - horizontal;
  return horizontal;
}

// Maps an angle (degrees) of type A or B by symmetry to an angle of the file.
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

// Whether the angles are within the file; outside, the profile is dark. For type C all horizontal angles are
// within it, by symmetry.
SHARED_FUNCTION bool profileHolds(uint type, ProfileRange range, vec2 angles) {
  if (angles.x < range.vertical.x || angles.x > range.vertical.y) return false;
  return type == kProfileTypeC || (angles.y >= range.horizontal.x && angles.y <= range.horizontal.y);
}

// The index of the angle below `angle` among `count` angles (two or more), if they are evenly spaced, as in
// most files.
SHARED_FUNCTION int lowerAngle(vec2 range, int count, float angle) {
  return clamp(int((angle - range.x) / (range.y - range.x) * float(count - 1)), 0, count - 2);
}

// The part (0..1) of the peak toward a unit vector in the light's frame, linear between the angles.
SHARED_FUNCTION float profileFraction(ProfileView profile, vec3 local) {
  ivec2 counts = profile.counts;
  ProfileRange range;
  range.vertical = vec2(verticalAngle(profile, 0), verticalAngle(profile, counts.x - 1));
  range.horizontal = vec2(horizontalAngle(profile, 0), horizontalAngle(profile, counts.y - 1));
  vec2 angles = profileAngles(profile.type, range, local);
  if (!profileHolds(profile.type, range, angles)) return 0.0f;
  ivec2 low = ivec2(lowerAngle(range.vertical, counts.x, angles.x), 0);
  while (low.x > 0 && angles.x < verticalAngle(profile, low.x)) --low.x;
  while (low.x + 2 < counts.x && angles.x > verticalAngle(profile, low.x + 1)) ++low.x;
  vec2 verticals = vec2(verticalAngle(profile, low.x), verticalAngle(profile, low.x + 1));
  vec2 part = vec2((angles.x - verticals.x) / (verticals.y - verticals.x), 0.0f);
  ivec2 next = ivec2(1, 0);
  if (counts.y > 1) {
    low.y = lowerAngle(range.horizontal, counts.y, angles.y);
    while (low.y > 0 && angles.y < horizontalAngle(profile, low.y)) --low.y;
    while (low.y + 2 < counts.y && angles.y > horizontalAngle(profile, low.y + 1)) ++low.y;
    vec2 horizontals = vec2(horizontalAngle(profile, low.y), horizontalAngle(profile, low.y + 1));
    part.y = (angles.y - horizontals.x) / (horizontals.y - horizontals.x);
    next.y = 1;
  }
  part = clamp(part, vec2(0.0f), vec2(1.0f));
  return mix(mix(profileValue(profile, low), profileValue(profile, low + ivec2(1, 0)), part.x),
             mix(profileValue(profile, low + ivec2(0, next.y)), profileValue(profile, low + next), part.x),
             part.y);
}

SHARED_END

#endif
