// Illuminance (lux) on each receiver by one light that met no caster.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/light.glsl.h"

#include "render/air/box.glsl.h"

layout(rgba32f) uniform readonly image2D receiverPosition;
layout(rgba32f) uniform readonly image2D receiverNormal;
uniform sampler2DArray boxDepths;          // kHasBox
layout(location = 0) flat in Air air;      // kHasAir
layout(location = 11) flat in AirBox box;  // kHasBox
layout(location = 0) out vec4 directLux;   // added to that of other lights

const int kLooks = 16;   // for what stands between, and
const int kPlaces = 32;  // for what it leaves

// Place `i` of `count` in the unit disk (Vogel 1979).
vec2 placeInDisk(int i, int count) {
  const float turn = 2.3999632 * float(i);
  return sqrt((float(i) + 0.5) / float(count)) * vec2(cos(turn), sin(turn));
}

// From the middle of what an emitter stands for to place `i` of `count` in it; `u` and `v`: across the light.
vec3 placeOnLight(int i, int count, vec3 u, vec3 v) {
  // Of a line, its part from half a step before to half a step after.
  if (kIsLine) return ((float(i) + 0.5) / float(count) - 0.5) * constants.direction;
  const vec2 place = constants.softness * placeInDisk(i, count);
  return place.x * u + place.y * v;
}

// The point of the receiver's plane that light passes to which goes to `offset` moved by `aside`.
vec3 onPlane(vec3 offset, vec3 normal, vec3 aside) {
  if (kEmitterType == kEmitterDirectional) {
    const vec3 along = normalize(constants.mapDepth);
    const float approach = dot(normal, along);
    return offset + aside - along * (dot(normal, aside) / (abs(approach) < 0.1 ? -0.1 : approach));
  }
  const vec3 there = offset + aside;
  const float height = dot(normal, offset), other = dot(normal, there);
  return there * clamp(other == 0 ? 1 : height / other, 0.5, 2);
}

// How far (m, along a map's axis) what the map shows toward `offset` is from the light; and `own`: the point
// itself.
float depthSeen(vec3 offset, vec2 middle, uint firstMap, out float own) {
  const bool isPerspective = kEmitterType != kEmitterDirectional;
  uint face = 0;
  const vec3 place = projected(offset, float(textureSize(shadowMaps, 0).x), face);
  const vec2 at = place.xy * (isPerspective ? 1 / place.z : 1) - middle + 0.5;
  const float seen = textureLod(shadowMaps, vec3(at, float(firstMap + face)), 0).r;
  own = place.z;
  if (isPerspective) return constants.depthOffset / (min(seen, 1) - constants.depthScale);
  const float depths = 1 / length(constants.mapDepth);
  own *= depths;
  return (seen - constants.depthOffset) * depths;
}

// The part of a light of some size that arrives: what stands between is looked for, and then the map is
// filtered as wide as the light is seen past it (Fernando 2005).
float softVisibility(vec3 offset, vec3 normal, vec2 middle, uint firstMap) {
  const bool isPerspective = kEmitterType != kEmitterDirectional;
  const vec3 along = isPerspective ? normalize(offset) : normalize(constants.mapDepth);
  const vec3 u = normalize(cross(along, abs(along.y) < 0.9 ? vec3(0, 1, 0) : vec3(1, 0, 0)));
  const vec3 v = cross(along, u);
  float own = 0, there = 0, depths = 0, found = 0;
  depthSeen(offset, middle, firstMap, own);
  // As wide as the nearest that is in the map may make it.
  const float nearest =
      -constants.depthOffset / (isPerspective ? constants.depthScale : length(constants.mapDepth));
  const float widest = isPerspective ? own / nearest - 1 : own - nearest;
  for (int i = 0; i < kLooks; ++i) {
    const vec3 at = onPlane(offset, normal, widest * placeOnLight(i, kLooks, u, v));
    const float seen = depthSeen(at, middle, firstMap, there);
    const float isBefore = seen < there ? 1 : 0;
    depths += isBefore * seen;
    found += isBefore;
  }
  if (found == 0) return litPart(offset, middle, firstMap);
  const float before = depths / found;
  const float wide = max(isPerspective ? own / before - 1 : own - before, 0);
  float sum = 0;
  for (int i = 0; i < kPlaces; ++i)
    sum += litPart(onPlane(offset, normal, wide * placeOnLight(i, kPlaces, u, v)), middle, firstMap);
  return sum / float(kPlaces);
}

// The point is moved off its surface so far that a plane never shades itself within the filter: (filter
// radius) * texel * sin(angle of incidence) along the normal.
float visibility(vec3 offset, vec3 normal, float cosine, vec2 middle, uint firstMap) {
  uint face = 0;
  float width = constants.texelSize;
  if (kEmitterType != kEmitterDirectional)
    width *= max(projected(offset, float(textureSize(shadowMaps, 0).x), face).z, 0);
  offset += width * (1.5 * sqrt(max(1 - cosine * cosine, 0)) + 0.3) * normal;
  return kIsSoft ? softVisibility(offset, normal, middle, firstMap) : litPart(offset, middle, firstMap);
}

vec3 illuminance(vec3 point, vec3 normal, vec3 origin, uint index) {
  const Emitter emitter = emitterAt(origin);
  const vec3 direction = emitterDirection(emitter, point);
  const float cosine = -dot(direction, normal);
  vec3 lux = cosine * emitterIlluminance(emitter, point);
  // Behind a gobo's light there is no place in it to look at.
  if (kHasGobo || kProfileType != kNoProfile) lux = lux == vec3(0) ? vec3(0) : lux * shape(direction);
  if (kMapCount > 0) {
    const vec3 from = kEmitterType == kEmitterDirectional ? constants.aim : origin;
    lux *= visibility(point - from, normal, cosine, middleOfMap(origin), index * kMapCount);
  }
  // Light from afar is as strong as it is said to be where it meets a surface.
  if (kHasAir && kEmitterType != kEmitterDirectional) {
    const float way = kHasBox ? boxDepthBetween(boxDepths, box, origin, point, box.firstLayer)
                              : meanFogDensity(air, origin.y, point.y) * distance(origin, point);
    lux *= exp(-air.extinction * way);
  }
  return cosine > 0 ? lux : vec3(0);
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = imageLoad(receiverPosition, pixel);
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  vec3 sum = vec3(0);
  if (kIsLine) {
    for (uint i = 0; i < constants.samples; ++i)
      sum += illuminance(point.xyz, normal, constants.position + float(i) * constants.direction, i);
  } else {
    sum = illuminance(point.xyz, normal, constants.position, 0);
  }
  directLux = vec4(point.a > 0 ? sum : vec3(0), 0);
}
