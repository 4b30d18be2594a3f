// Illuminance (lux) on each receiver by one light that met no caster: all of the lamp in closed form, times
// the part of it that is seen.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/frame_data.h"

#include "lights/lamp_irradiance.h"
#include "render/light_shape.glsl.h"

layout(constant_id = 0) const uint kForm = kLampBall;    // kLamp...
layout(constant_id = 1) const bool kHasShadows = false;  // may something stand before it
layout(constant_id = 2) const bool kHasRadius = false;   // of balls, and of light from afar
layout(constant_id = 5) const bool kHasAir = false;
layout(push_constant, scalar) uniform Constants {
  LampConstants constants;
};
#include "render/air/box.glsl.h"

uniform texture2D receiverPosition;
uniform texture2D receiverNormal;
uniform texture2D seenParts;               // kHasShadows
uniform sampler2DArray boxDepths;          // kHasBox
layout(location = 0) flat in Air air;      // kHasAir
layout(location = 11) flat in AirBox box;  // kHasBox
layout(location = 0) out vec4 directLux;   // added to that of other lights

// Of light from `origin` (m), what the air lets through.
float throughAir(vec3 origin, vec3 point) {
  const float way = kHasBox ? boxDepthBetween(boxDepths, box, origin, point, box.firstLayer)
                            : meanFogDensity(air, origin.y, point.y) * distance(origin, point);
  return exp(-air.extinction * way);
}

// The same of the light of a panel or a line, from places all over it.
float throughAirFromAll(vec3 point, vec3 normal) {
  const int along = 4, across = kForm == kLampLine ? 1 : 4;
  const vec3 front = cross(constants.v, constants.u);
  float sum = 0, through = 0;
  for (int i = 0; i < along * across; ++i) {
    const vec2 at = (vec2(float(i % along), float(i / along)) + 0.5) / vec2(float(along), float(across));
    const vec3 origin =
        constants.position + at.x * constants.u + (kForm == kLampLine ? vec3(0) : at.y * constants.v);
    const vec3 offset = origin - point;
    const float squared = max(dot(offset, offset), 1e-30);
    float weight = max(dot(offset, normal), 0) / (squared * sqrt(squared));
    if (kForm == kLampPanel) weight *= max(-dot(offset, front), 0) * inversesqrt(squared);
    sum += weight;
    through += weight * throughAir(origin, point);
  }
  return sum > 0 ? through / sum : 0;
}

float cosineOf(float cosine, float sineSquared) {
  return kHasRadius ? diskCosine(cosine, sineSquared) : max(cosine, 0);
}

vec3 illuminance(vec3 point, vec3 normal) {
  if (kForm == kLampAfar)
    return constants.power * cosineOf(-dot(constants.direction, normal), constants.radius * constants.radius);
  const vec3 offset = constants.position - point;
  if (kForm == kLampPanel || kForm == kLampLine) {
    const float whole = kForm == kLampPanel ? length(cross(constants.v, constants.u)) : length(constants.u);
    const float integral = kForm == kLampPanel ? panelIntegral(offset, constants.u, constants.v, normal)
                                               : segmentIntegral(offset, constants.u, normal);
    const float through = kHasAir && integral > 0 ? throughAirFromAll(point, normal) : 1;
    return constants.power * (integral / whole * through);
  }
  const float squared = dot(offset, offset), radius = constants.radius;
  const vec3 toward = offset * inversesqrt(squared);
  vec3 lux = constants.power * (cosineOf(dot(toward, normal), radius * radius / squared) / squared);
  if (squared <= radius * radius || lux == vec3(0)) return vec3(0);  // from within nothing is seen
  if (kForm == kLampSpot)
    lux *= coneFalloff(-dot(constants.direction, toward), constants.coneScale, constants.coneOffset);
  // Behind a gobo's light there is no place in it to look at.
  if (kHasGobo || kProfileType != kNoProfile)
    lux = lux == vec3(0) ? vec3(0) : lux * shape(constants.direction, constants.goboTurn, -toward);
  return kHasAir ? lux * throughAir(constants.position, point) : lux;
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 point = texelFetch(receiverPosition, pixel, 0);
  if (point.a <= 0) discard;
  vec3 lux = illuminance(point.xyz, texelFetch(receiverNormal, pixel, 0).xyz);
  if (kHasShadows) lux *= texelFetch(seenParts, pixel, 0).r;
  directLux = vec4(lux, 0);
}
