// Fast approximate anti-aliasing (Lottes, FXAA 3.11, quality) of the pixels that are marked as edges: the
// picture is read a part of a pixel across the edge there, as far as the edge's slope has come between its
// two ends.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "viewer/show/edge_luma.glsl.h"

layout(location = 0) out vec4 smoothed;

const float kMostOfSpeck = 0.75;  // how far what is smaller than a pixel is softened
const float kSteps[8] = float[](1, 1.5, 2, 2, 2, 2, 4, 8);  // pixels, along the edge

vec2 texel;

float lumaBeside(vec2 place, vec2 pixels) {
  return lumaAt(place + pixels * texel);
}

// How far along the edge (pixels) its luma, `middle` between the two sides, stays within `most`; and by how
// much it has changed where it ends.
vec2 endOfEdge(vec2 place, vec2 along, float middle, float most) {
  float distance = 0, change = 0;
  for (int i = 0; i < kSteps.length(); ++i) {
    distance += kSteps[i];
    change = lumaBeside(place, distance * along) - middle;
    if (abs(change) >= most) break;
  }
  return vec2(distance, change);
}

void main() {
  texel = 1 / vec2(textureSize(picture, 0));
  const vec2 place = gl_FragCoord.xy * texel;
  const float here = lumaAt(place);
  const float up = lumaBeside(place, vec2(0, -1)), down = lumaBeside(place, vec2(0, 1));
  const float left = lumaBeside(place, vec2(-1, 0)), right = lumaBeside(place, vec2(1, 0));
  const float most = max(max(max(up, down), max(left, right)), here);
  const float least = min(min(min(up, down), min(left, right)), here);
  const float upLeft = lumaBeside(place, vec2(-1, -1)), upRight = lumaBeside(place, vec2(1, -1));
  const float downLeft = lumaBeside(place, vec2(-1, 1)), downRight = lumaBeside(place, vec2(1, 1));
  const float around = (2 * (up + down + left + right) + upLeft + upRight + downLeft + downRight) / 12;
  const float speck = smoothstep(0, 1, clamp(abs(around - here) / (most - least), 0, 1));

  const float acrossRows = abs(upLeft + downLeft - 2 * left) + 2 * abs(up + down - 2 * here) +
                           abs(upRight + downRight - 2 * right);
  const float acrossColumns = abs(upLeft + upRight - 2 * up) + 2 * abs(left + right - 2 * here) +
                              abs(downLeft + downRight - 2 * down);
  const bool isLevel = acrossRows >= acrossColumns;
  const float before = isLevel ? up : left, after = isLevel ? down : right;
  const bool isBefore = abs(before - here) >= abs(after - here);
  const vec2 along = isLevel ? vec2(1, 0) : vec2(0, 1);
  const vec2 across = (isBefore ? -1.0 : 1.0) * along.yx;
  const float other = isBefore ? before : after;

  const vec2 onEdge = place + 0.5 * across * texel;
  const float middle = 0.5 * (here + other), ends = 0.25 * abs(other - here);
  const vec2 back = endOfEdge(onEdge, -along, middle, ends), ahead = endOfEdge(onEdge, along, middle, ends);
  const vec2 nearer = back.x < ahead.x ? back : ahead;
  // Of the two sides of an edge one is moved, that from which the nearer end turns away.
  const bool turnsAway = (nearer.y < 0) != (here < middle);
  const float slope = turnsAway ? 0.5 - nearer.x / (back.x + ahead.x) : 0;
  const float shift = max(slope, kMostOfSpeck * speck * speck);
  smoothed = vec4(textureLod(picture, place + shift * across * texel, 0).rgb, 1);
}
