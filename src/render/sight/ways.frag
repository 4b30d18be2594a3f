// Where each pixel's line of sight goes through the water of an object: from its surface as far as what is
// seen in it; or from an eye in the water, and on from where its surface reflects totally.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "core/octahedral.h"
#include "optics/refraction.h"
#include "render/sight/ways_data.h"

layout(constant_id = 0) const bool kIsByRays = false;  // exits tell how long ways are, otherwise receivers
layout(push_constant, scalar) uniform Constants {
  WayConstants constants;
};
uniform texture2D receiverPosition;
uniform texture2D casterPosition;
uniform texture2D casterNormal;
uniform texture2D casterExit;
uniform texture2D casterDirection;
layout(location = 0) out vec4 wayStart;  // m; a = its length, 0 where there is none
// Octahedral direction, away from the eye; the part of light from its start that comes to the eye, without
// what is taken by as many m in the water before it.
layout(location = 1) out vec4 wayDirection;

void fromEye(vec4 receiver, vec4 caster) {
  const vec2 place = 2 * gl_FragCoord.xy / constants.imageSize - 1;
  const vec3 ray = normalize(constants.middle + place.x * constants.right + place.y * constants.down);
  const vec3 end = caster.a > 0 ? caster.xyz : receiver.xyz;
  const bool ends = caster.a > 0 || receiver.a > 0;
  wayStart = vec4(constants.eye, ends ? distance(end, constants.eye) : constants.farthest);
  wayDirection = vec4(octahedralFromDirection(ray), 1, 0);
}

void fromSurface(ivec2 pixel, vec4 receiver, vec4 caster) {
  const vec4 exit = texelFetch(casterExit, pixel, 0);
  const vec3 start = exit.xyz, direction = normalize(texelFetch(casterDirection, pixel, 0).xyz);
  const vec3 normal = normalize(texelFetch(casterNormal, pixel, 0).xyz);  // on the side of the eye
  const bool isReflected = constants.kind == kWayReflected;
  const bool isThere = caster.a == float(constants.number) && (dot(direction, normal) < 0) != isReflected;
  float way = receiver.a > 0 ? dot(receiver.xyz - start, direction) : constants.farthest;
  if (kIsByRays) way = min(exit.a, constants.farthest);
  const vec3 before = caster.xyz - constants.eye;
  const float eta = 1 / constants.ior;
  const float through =
      (1 - fresnelReflectance(clamp(-dot(normalize(before), normal), 0, 1), eta)) * eta * eta;
  wayStart = vec4(start, isThere ? max(way, 0) : 0);
  wayDirection =
      vec4(octahedralFromDirection(direction), isReflected ? vec2(1, length(before)) : vec2(through, 0));
}

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  // Elsewhere the casters' images are those of another frame.
  const uvec2 inRegion = uvec2(pixel) - constants.region.xy;  // which wraps round where it is less
  const bool mayHaveCaster = all(lessThan(inRegion, constants.region.zw));
  const vec4 receiver = texelFetch(receiverPosition, pixel, 0);
  const vec4 caster = mayHaveCaster ? texelFetch(casterPosition, pixel, 0) : vec4(0);
  if (constants.kind == kWayFromEye)
    fromEye(receiver, caster);
  else
    fromSurface(pixel, receiver, caster);
}
