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

// The point is moved off its surface so far that a plane never shades itself within the filter: (filter
// radius) * texel * sin(angle of incidence) along the normal.
float visibility(vec3 offset, vec3 normal, float cosine, vec2 middle, uint firstMap) {
  uint face = 0;
  float width = constants.texelSize;
  if (kEmitterType != kEmitterDirectional)
    width *= max(projected(offset, float(textureSize(shadowMaps, 0).x), face).z, 0);
  offset += width * (1.5 * sqrt(max(1 - cosine * cosine, 0)) + 0.3) * normal;
  return litPart(offset, middle, firstMap);
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
