// The luminance of a sky, where a pixel sees no receiver.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "optics/refraction.h"
#include "render/sky/sky_data.h"

layout(constant_id = 0) const uint kWay = kSkyOpen;
layout(push_constant, scalar) uniform Constants {
  SkyConstants constants;
};
uniform texture2D sky;
// Not with kSkyOpen:
uniform texture2D receiverPosition;
uniform texture2D casterPosition;
uniform texture2D casterNormal;
uniform texture2D casterDirection;
layout(location = 0) out vec4 skyLight;  // added to that of other skies

struct SkyView {
  int levels;
};
int skyLevelCount(SkyView view) {
  return view.levels;
}
ivec2 skyLevelSize(SkyView view, int level) {
  return max(textureSize(sky, 0) >> level, ivec2(1));  // software devices have one level for several pixels
}
vec3 skyTexel(SkyView view, ivec2 at, int level) {
  return texelFetch(sky, at, level).rgb;
}
#include "lights/sky_lookup.h"

const float kWidestLook = 0.2;  // radians; at a caster's rim neighbors have nothing to do with each other

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  vec3 toward = vec3(0);
  float width = 0;
  if (kWay == kSkyOpen) {
    const vec2 place = 2 * gl_FragCoord.xy / constants.imageSize - 1;
    const vec3 ray = constants.middle + place.x * constants.right + place.y * constants.down;
    toward = normalize(ray);
    width = constants.width / length(ray);
  } else {
    const vec4 position = texelFetch(casterPosition, pixel, 0);
    if (kWay == kSkyThrough)
      toward = normalize(texelFetch(casterDirection, pixel, 0).xyz);
    else
      toward = reflectDirection(normalize(position.xyz - constants.eye),
                                normalize(texelFetch(casterNormal, pixel, 0).xyz));
    width = constants.spacing * max(length(dFdx(toward)), length(dFdy(toward)));
    // Beside pixels without a caster there is no difference to take.
    if (!(width <= kWidestLook)) width = kWidestLook;
    if (position.a != float(constants.number) || texelFetch(receiverPosition, pixel, 0).a > 0) discard;
  }
  skyLight = vec4(skyLuminance(SkyView(constants.levels), constants.sight, toward, width), 0);
}
