// Copies a picture, and marks the pixels whose luma differs from their neighbors', by a depth of 1: software
// devices skip pixels by their depth, but not by a branch.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "viewer/show/edge_luma.glsl.h"

layout(location = 0) out vec4 copy;

const float kLeastContrast = 0.0312;  // in the dark
const float kLeastRelative = 0.125;   // of the brightest neighbor

void main() {
  const vec2 texel = 1 / vec2(textureSize(picture, 0));
  const vec2 place = gl_FragCoord.xy * texel;
  copy = vec4(textureLod(picture, place, 0).rgb, 1);
  const float here = lumaAt(place);
  const float up = lumaAt(place - vec2(0, texel.y)), down = lumaAt(place + vec2(0, texel.y));
  const float left = lumaAt(place - vec2(texel.x, 0)), right = lumaAt(place + vec2(texel.x, 0));
  const float most = max(max(max(up, down), max(left, right)), here);
  const float least = min(min(min(up, down), min(left, right)), here);
  gl_FragDepth = most - least < max(kLeastContrast, kLeastRelative * most) ? 0 : 1;
}
