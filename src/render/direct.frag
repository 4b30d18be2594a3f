// Illuminance (lux) on each receiver by one emitter's light that met no caster.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(constant_id = 0) const uint kEmitterType = kEmitterPoint;
layout(constant_id = 1) const uint kMapCount = 1;  // 0: nothing can shade; 1; or 6, the faces of a cube about the light: +x, -x, +y, -y, +z, -z
layout(push_constant, scalar) uniform Constants { DirectConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D receiverPosition;
layout(set = 0, binding = 1, rgba32f) uniform readonly image2D receiverNormal;
layout(set = 0, binding = 2) uniform sampler2DArray shadowMaps;
layout(location = 0) out vec4 directLux;  // added to that of other emitters

// Place and depth of `point` in the map, before the division by depth.
vec3 projected(vec3 point) {
  const vec4 p = vec4(point, 1);
  return vec3(dot(constants.mapX, p), dot(constants.mapY, p), dot(constants.mapDepth, p));
}

// The same in the face of a cube that looks along the largest part of `offset`, a vector from the light.
vec3 projectedOnCube(vec3 offset, float tangent, out uint face) {
  const vec3 size = abs(offset);
  vec3 place;
  if (size.x >= size.y && size.x >= size.z) {
    face = offset.x > 0 ? 0u : 1u;
    place = vec3(offset.x > 0 ? offset.z : -offset.z, offset.y, size.x);
  } else if (size.y >= size.z) {
    face = offset.y > 0 ? 2u : 3u;
    place = vec3(offset.y > 0 ? -offset.z : offset.z, offset.x, size.y);
  } else {
    face = offset.z > 0 ? 4u : 5u;
    place = vec3(offset.z > 0 ? -offset.x : offset.x, offset.y, size.z);
  }
  return vec3(place.xy / tangent, place.z);
}

// The part of the light that a tent three texels wide finds unhindered. The point is moved off its surface so far that a plane
// never shades itself within the filter: (filter radius) * texel * sin(angle of incidence) along the normal.
float visibility(vec3 point, vec3 normal, float cosine) {
  const bool isPerspective = kEmitterType != kEmitterDirectional;
  const bool isCube = kMapCount > 1;
  const vec2 texels = vec2(textureSize(shadowMaps, 0).xy);
  const float tangent = 0.5 * constants.texelSizePerDepth * texels.x;
  uint face = 0;
  const float distance = isCube ? projectedOnCube(point - constants.emitter.position, tangent, face).z : projected(point).z;
  const float width = constants.texelSize + constants.texelSizePerDepth * max(distance, 0);
  point += width * (2.2 * sqrt(max(1 - cosine * cosine, 0)) + 0.3) * normal;
  vec3 place = isCube ? projectedOnCube(point - constants.emitter.position, tangent, face) : projected(point);
  if (isPerspective) {
    if (place.z <= 0) return 1;
    place = vec3(place.xy / place.z, constants.depthScale + constants.depthOffset / place.z);
  }
  if (any(greaterThan(abs(place.xy), vec2(1)))) return 1;
  const vec2 corner = (place.xy * 0.5 + 0.5) * texels - 1;
  const vec2 first = floor(corner);
  const vec2 after = 0.5 * (corner - first);
  const vec3 columns = vec3(0.5 - after.x, 0.5, after.x);
  const vec3 rows = vec3(0.5 - after.y, 0.5, after.y);
  const ivec2 texel = clamp(ivec2(first), ivec2(0), ivec2(texels) - 3);
  const int layer = int(constants.firstMap + face);
  const float depth = min(place.z, 1);
  float sum = 0;
  for (int y = 0; y < 3; ++y)
    for (int x = 0; x < 3; ++x)
      sum += columns[x] * rows[y] * step(depth, texelFetch(shadowMaps, ivec3(texel + ivec2(x, y), layer), 0).r);
  return sum;
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = imageLoad(receiverPosition, pixel);
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  Emitter emitter = constants.emitter;
  emitter.type = kEmitterType;
  const float cosine = -dot(emitterDirection(emitter, point.xyz), normal);
  vec3 lux = vec3(0);
  if (point.a > 0 && cosine > 0) {
    lux = cosine * emitterIlluminance(emitter, point.xyz);
    if (kMapCount > 0) lux *= visibility(point.xyz, normal, cosine);
  }
  directLux = vec4(lux, 0);
}
