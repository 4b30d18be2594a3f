// Adds the light of one set of planes to the receiver points where the virtual camera sees them: blended from
// the two planes around each point (Iwasaki 2005b, 4.3), or from the nearer one where planes follow the
// receivers.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "techniques/planes/shader_data.h"

layout(constant_id = 0) const uint kChannels = 3;
layout(constant_id = 1) const uint kFollowsReceivers = 1;
layout(push_constant, scalar) uniform Constants {
  ShadeConstants constants;
};
layout(rgba32f) uniform readonly image2D receiverPosition;
layout(rgba32f) uniform readonly image2D receiverNormal;
uniform sampler2DArray seenDepths;  // by the virtual camera, a layer a window
uniform usampler2DArray textures;
layout(location = 0) out vec4 causticsLux;  // added to that of other sets

// Of the four texels about a place on a plane, in the order of textureGather.
struct Units {
  vec4 channel[3];
};

// `corner` is the first of the four.
Units unitsAround(uint layer, vec2 corner) {
  const vec2 at = (corner + 1) / constants.textureSize;
  Units units;
  for (uint c = 0; c < kChannels; ++c)
    units.channel[c] = vec4(textureGather(textures, vec3(at, layer + c * layersOfChannel(constants.set))));
  return units;
}

vec4 bilinearWeights(vec2 part) {
  return vec4(1 - part.x, part.x, part.x, 1 - part.x) * vec4(part.y, part.y, 1 - part.y, 1 - part.y);
}

// Of the coarse part, on as much as a texel of the window, at a place in the window's texels.
vec3 coarseUnitsAt(uint texture, float size, vec2 place) {
  const vec2 last = vec2(floor(size / kCoarseness) - 1);
  const vec2 within = clamp((place + 0.5) / kCoarseness - 0.5, vec2(0), max(last - 1e-3, 0));
  const vec2 origin = coarseTile(texture) * floor(constants.textureSize / kCoarseness);
  const Units units = unitsAround(coarseLayer(constants.set, texture), origin + floor(within));
  const vec4 weights = bilinearWeights(fract(within)) / (kCoarseness * kCoarseness);
  vec3 sum;
  for (uint c = 0; c < 3; ++c) sum[c] = dot(weights, units.channel[min(c, kChannels - 1)]);
  return sum;
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
  float between =
      set.depthStep > 0 ? clamp((depth - set.firstDepth) / set.depthStep, 0, float(set.planes - 1)) : 0;
  if (kFollowsReceivers != 0) between = floor(between + 0.5);
  const uint nearer = min(uint(between), set.planes - 1);
  const uint farther = min(nearer + 1, set.planes - 1);

  const uint nearerTexture = textureIndex(set, nearer, window),
             fartherTexture = textureIndex(set, farther, window);
  const vec2 corner = floor(place);
  Units units = unitsAround(nearerTexture, corner);
  vec3 coarse = coarseUnitsAt(nearerTexture, last + 1, place);
  if (kFollowsReceivers == 0) {
    const float part = between - float(nearer);
    const Units beyond = unitsAround(fartherTexture, corner);
    for (uint c = 0; c < kChannels; ++c)
      units.channel[c] = mix(units.channel[c], beyond.channel[c], vec4(part));
    coarse = mix(coarse, coarseUnitsAt(fartherTexture, last + 1, place), part);
  }

  // The side away from the light, at a place where the virtual camera sees the other.
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  const float cosine = -dot(normal, set.axisW);
  if (cosine <= 0) return;
  // A texel's own slope, and half a texel of its neighbor's, may part a point from what the virtual camera
  // saw.
  const float slope = sqrt(max(1 - cosine * cosine, 0)) / max(cosine, 0.05);
  const float depthRange = set.farthestDepth - set.nearestDepth;
  const float tolerance = 2.0 * slope / set.windows[window].texelsPerMeter + 1e-4 * depthRange;
  const float nearestSeen = (depth - tolerance - set.nearestDepth) / depthRange;
  // 1 where the virtual camera sees nothing.
  const vec4 seen = textureGather(seenDepths, vec3((corner + 1) / constants.textureSize, window));
  const vec4 weights =
      bilinearWeights(place - corner) * vec4(greaterThanEqual(seen, vec4(min(nearestSeen, 1))));
  vec3 sum = coarse * dot(weights, vec4(1));
  for (uint c = 0; c < 3; ++c) sum[c] += dot(weights, units.channel[min(c, kChannels - 1)]);
  const float texels = set.windows[window].texelsPerMeter;
  // What follows the receivers was left by flux; a texel's square meters on the surface are those across the
  // axis over the cosine.
  if (kFollowsReceivers != 0) sum *= cosine;
  causticsLux = vec4(sum * set.luxMetersSquaredPerUnit * (texels * texels), 0);
}
