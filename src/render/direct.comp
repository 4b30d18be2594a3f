// Illuminance (lux) on each receiver by light that met no caster.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Constants { DirectConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D receiverNormal;
layout(set = 0, binding = 2) uniform sampler2DArrayShadow shadowMaps;
layout(set = 0, binding = 3, rgba32f) uniform writeonly image2D directLux;  // a = 1 where there is a receiver

uint cubeFace(vec3 direction) {
  const vec3 size = abs(direction);
  if (size.x >= size.y && size.x >= size.z) return direction.x > 0 ? 0u : 1u;
  if (size.y >= size.z) return direction.y > 0 ? 2u : 3u;
  return direction.z > 0 ? 4u : 5u;
}

// The part of the light that a tent three texels wide finds unhindered. The point is moved off its surface so far that a plane
// never shades itself within the filter: (filter radius) * texel * sin(angle of incidence) along the normal.
float visibility(ShadowedEmitter lit, vec3 point, vec3 normal, float cosine) {
  if (lit.mapCount == 0) return 1;
  const uint face = lit.mapCount == 1 ? 0u : cubeFace(point - lit.emitter.position);
  const mat4 worldToMap = constants.maps.map[lit.firstMap + face].worldToMap;
  const float depth = (worldToMap * vec4(point, 1)).w;
  const float texel = lit.texelSize + lit.texelSizePerDepth * max(depth, 0);
  const float offset = texel * (2.2 * sqrt(max(1 - cosine * cosine, 0)) + 0.3);
  const vec4 clip = worldToMap * vec4(point + offset * normal, 1);
  const vec3 place = clip.xyz / clip.w;
  if (clip.w <= 0 || any(greaterThan(abs(place.xy), vec2(1)))) return 1;
  const vec2 corner = place.xy * 0.5 + 0.5;
  const vec2 halfTexel = 0.5 / vec2(textureSize(shadowMaps, 0).xy);
  float sum = 0;
  for (int y = -1; y <= 1; y += 2)
    for (int x = -1; x <= 1; x += 2)
      sum += textureGrad(shadowMaps,
                         vec4(corner + vec2(x, y) * halfTexel, lit.firstMap + face, min(place.z, 1)), vec2(0),
                         vec2(0));
  return 0.25 * sum;
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(directLux)))) return;
  const vec4 point = imageLoad(receiverPosition, pixel);
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  vec3 lux = vec3(0);
  if (point.a > 0)
    for (uint i = 0; i < constants.emitterCount; ++i) {
      const ShadowedEmitter lit = constants.emitters.emitter[i];
      const float cosine = -dot(emitterDirection(lit.emitter, point.xyz), normal);
      if (cosine > 0)
        lux += cosine * visibility(lit, point.xyz, normal, cosine) * emitterIlluminance(lit.emitter, point.xyz);
    }
  imageStore(directLux, pixel, vec4(lux, point.a));
}
