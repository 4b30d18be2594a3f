// Adds the light of one set of planes to the receiver points where the virtual camera sees them: blended from the two planes
// around each point (Iwasaki 2005b, 4.3), or from the nearer one where planes follow the receivers.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/illumination_textures/shader_data.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(constant_id = 1) const uint kFollowsReceivers = 1;
layout(push_constant, scalar) uniform Constants { ShadeConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D receiverNormal;
layout(set = 0, binding = 2) uniform texture2DArray seenDepths;  // by the virtual camera, a layer a window
layout(location = 0) out vec4 causticsLux;  // added to that of other sets

// Units on the plane at a texel of the window.
vec3 unitsAt(uint firstWord, uint textureSize, ivec2 texel) {
  const uint word = firstWord + (uint(texel.y) * textureSize + uint(texel.x)) * kChannels;
  if (kChannels == 1) return vec3(float(constants.textures.units[word]));
  return vec3(float(constants.textures.units[word]), float(constants.textures.units[word + 1]),
              float(constants.textures.units[word + 2]));
}

void main() {
  causticsLux = vec4(0);
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = imageLoad(receiverPosition, pixel);
  if (point.w == 0) return;
  const PlaneSet set = constants.set;

  const float last = float(set.textureSize) - 1;
  uint window = 0;
  vec2 place = windowTexel(set, 0, point.xyz) - 0.5;
  if (any(lessThan(place, vec2(0))) || any(greaterThanEqual(place, vec2(last)))) {
    window = 1;
    place = windowTexel(set, 1, point.xyz) - 0.5;
    if (any(lessThan(place, vec2(-0.5))) || any(greaterThanEqual(place, vec2(last + 0.5)))) return;
    place = clamp(place, vec2(0), vec2(last - 1e-3));
  }
  const float depth = dot(point.xyz, set.axisW);
  float between = set.depthStep > 0 ? clamp((depth - set.firstDepth) / set.depthStep, 0, float(set.planes - 1)) : 0;
  if (kFollowsReceivers != 0) between = floor(between + 0.5);
  const uint nearer = min(uint(between), set.planes - 1);
  const uint farther = min(nearer + 1, set.planes - 1);
  const uint nearerStart = textureStart(set, nearer, window, kChannels);
  const uint fartherStart = textureStart(set, farther, window, kChannels);

  const ivec2 corner = ivec2(place);
  vec3 units[4];
  vec3 most = vec3(0);
  for (int i = 0; i < 4; ++i) {
    const ivec2 texel = corner + ivec2(i & 1, i >> 1);
    units[i] = unitsAt(nearerStart, set.textureSize, texel);
    if (kFollowsReceivers == 0)
      units[i] = mix(units[i], unitsAt(fartherStart, set.textureSize, texel), between - float(nearer));
    most = max(most, units[i]);
  }
  if (most == vec3(0)) return;

  // The side away from the light, at a place where the virtual camera sees the other.
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  const float cosine = -dot(normal, set.axisW);
  if (cosine <= 0) return;
  // A texel's own slope, and half a texel of its neighbour's, may part a point from what the virtual camera saw.
  const float slope = sqrt(max(1 - cosine * cosine, 0)) / max(cosine, 0.05);
  const float depthRange = set.farthestDepth - set.nearestDepth;
  const float tolerance = 2.0 * slope / set.windows[window].texelsPerMetre + 1e-4 * depthRange;
  const float nearestSeen = (depth - tolerance - set.nearestDepth) / depthRange;
  const vec2 part = place - vec2(corner);
  vec3 sum = vec3(0);
  for (int i = 0; i < 4; ++i) {
    const ivec2 offset = ivec2(i & 1, i >> 1);
    const float seen = texelFetch(seenDepths, ivec3(corner + offset, window), 0).r;  // 1 where it sees nothing
    if (seen < min(nearestSeen, 1)) continue;
    const vec2 weights = mix(1 - part, part, vec2(offset));
    sum += weights.x * weights.y * units[i];
  }
  const float texels = set.windows[window].texelsPerMetre;
  // What follows the receivers was left by flux; a texel's square metres on the surface are those across the axis over the cosine.
  if (kFollowsReceivers != 0) sum *= cosine;
  causticsLux = vec4(sum * set.luxMetresSquaredPerUnit * (texels * texels), 0);
}
