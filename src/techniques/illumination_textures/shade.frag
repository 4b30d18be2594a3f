// Adds the light of one set of planes to the receiver points where the virtual camera sees them: blended from the two planes
// around each point (Iwasaki 2005b, 4.3), or from the nearer one where planes follow the receivers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/illumination_textures/shader_data.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(constant_id = 1) const uint kFollowsReceivers = 1;
layout(push_constant, scalar) uniform Constants { ShadeConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D receiverNormal;
layout(set = 0, binding = 2) uniform sampler2DArray seenDepths;  // by the virtual camera, a layer a window
layout(set = 0, binding = 3) uniform usampler2DArray textures;
layout(location = 0) out vec4 causticsLux;  // added to that of other sets

// Of the four texels about a place on a plane, in the order of textureGather.
struct Units {
  vec4 channel[3];
};

Units unitsAt(uint plane, uint window, vec2 at) {
  const uint layer = textureLayer(constants.set, plane, window, kChannels);
  Units units;
  for (uint c = 0; c < kChannels; ++c) units.channel[c] = vec4(textureGather(textures, vec3(at, layer + c)));
  return units;
}

void main() {
  causticsLux = vec4(0);
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = imageLoad(receiverPosition, pixel);
  if (point.w == 0) return;
  const PlaneSet set = constants.set;

  uint window = 0;
  float last = set.windows[0].size - 1;
  vec2 place = windowTexel(set, 0, point.xyz) - 0.5;
  if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(last)))) {
    window = 1;
    last = set.windows[1].size - 1;
    place = windowTexel(set, 1, point.xyz) - 0.5;
    if (any(lessThan(place, vec2(-0.5))) || any(greaterThanEqual(place, vec2(last + 0.5)))) return;
    place = clamp(place, vec2(0), vec2(last - 1e-3));
  }
  const float depth = dot(point.xyz, set.axisW);
  float between = set.depthStep > 0 ? clamp((depth - set.firstDepth) / set.depthStep, 0, float(set.planes - 1)) : 0;
  if (kFollowsReceivers != 0) between = floor(between + 0.5);
  const uint nearer = min(uint(between), set.planes - 1);
  const uint farther = min(nearer + 1, set.planes - 1);

  const vec2 corner = floor(place);
  const vec2 at = (corner + 1) / constants.textureSize;
  Units units = unitsAt(nearer, window, at);
  vec4 most = vec4(0);
  const Units behind = kFollowsReceivers == 0 ? unitsAt(farther, window, at) : units;
  for (uint c = 0; c < kChannels; ++c) {
    if (kFollowsReceivers == 0) units.channel[c] = mix(units.channel[c], behind.channel[c], vec4(between - float(nearer)));
    most = max(most, units.channel[c]);
  }
  if (most == vec4(0)) return;

  // The side away from the light, at a place where the virtual camera sees the other.
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  const float cosine = -dot(normal, set.axisW);
  if (cosine <= 0) return;
  // A texel's own slope, and half a texel of its neighbour's, may part a point from what the virtual camera saw.
  const float slope = sqrt(max(1 - cosine * cosine, 0)) / max(cosine, 0.05);
  const float depthRange = set.farthestDepth - set.nearestDepth;
  const float tolerance = 2.0 * slope / set.windows[window].texelsPerMetre + 1e-4 * depthRange;
  const float nearestSeen = (depth - tolerance - set.nearestDepth) / depthRange;
  const vec2 part = place - corner;
  // 1 where the virtual camera sees nothing.
  const vec4 seen = textureGather(seenDepths, vec3(at, window));
  const vec4 weights = vec4(1 - part.x, part.x, part.x, 1 - part.x) * vec4(part.y, part.y, 1 - part.y, 1 - part.y) *
                       vec4(greaterThanEqual(seen, vec4(min(nearestSeen, 1))));
  vec3 sum;
  for (uint c = 0; c < 3; ++c) sum[c] = dot(weights, units.channel[min(c, kChannels - 1)]);
  const float texels = set.windows[window].texelsPerMetre;
  // What follows the receivers was left by flux; a texel's square metres on the surface are those across the axis over the cosine.
  if (kFollowsReceivers != 0) sum *= cosine;
  causticsLux = vec4(sum * set.luxMetresSquaredPerUnit * (texels * texels), 0);
}
