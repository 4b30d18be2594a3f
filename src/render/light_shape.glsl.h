// A light's gobo and its profile.
#include "lights/light_shape.h"

layout(constant_id = 3) const bool kHasGobo = false;
layout(constant_id = 4) const uint kProfileType = kNoProfile;  // else kProfileType...
uniform sampler2D gobo;
// Row 0 and column 0: vertical and horizontal angles (degrees). The rest: parts of the peak, a row for each
// horizontal angle.
uniform sampler2D profile;

struct ProfileView {
  uint type;
  ivec2 counts;
};
float verticalAngle(ProfileView view, int i) {
  return texelFetch(profile, ivec2(i + 1, 0), 0).r;
}
float horizontalAngle(ProfileView view, int i) {
  return texelFetch(profile, ivec2(0, i + 1), 0).r;
}
float profileValue(ProfileView view, ivec2 at) {
  return texelFetch(profile, at + 1, 0).r;
}
#include "lights/profile_lookup.h"

// The part (0..1) of a light's peak along `direction` that gobo and profile let through, within the cone.
// `axis`: the light's own direction. `goboTurn`: of placeInGobo.
vec3 shape(vec3 axis, vec2 goboTurn, vec3 direction) {
  const vec3 local = alongFrame(lightFrame(axis), direction);
  vec3 part = vec3(1);
  if (kProfileType != kNoProfile)
    part *= profileFraction(ProfileView(kProfileType, textureSize(profile, 0) - 1), local);
  if (kHasGobo) {
    const vec2 fromMiddle = placeInGobo(goboTurn, local);
    part *= textureLod(gobo, 0.5 + fromMiddle / vec2(textureSize(gobo, 0)), 0).rgb;
  }
  return part;
}
