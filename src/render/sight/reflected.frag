// The receiver that glass reflects (Fresnel), on the side of the viewer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/sight/sight_data.h"

#include "optics/refraction.h"
#include "render/sight/find_receiver.glsl.h"

layout(push_constant, scalar) uniform Constants {
  SightConstants constants;
};
uniform texture2D casterPosition;
uniform texture2D casterNormal;
uniform texture2D casterDirection;
uniform texture2DArray depths;
uniform utexture2DArray normals;
uniform utexture2DArray albedos;
layout(location = 0) out vec4 receiverPosition;
layout(location = 1) out vec4 receiverNormal;  // a = reflectance
layout(location = 2) out vec4 receiverAlbedo;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 position = texelFetch(casterPosition, pixel, 0);
  const bool isMine = position.a == float(constants.number);
  const vec4 normal = texelFetch(casterNormal, pixel, 0);
  const vec3 facing = normalize(normal.xyz);
  const vec3 incident = normalize(position.xyz - constants.eye);
  float reflectance = fresnelReflectance(clamp(-dot(incident, facing), 0, 1),
                                         normal.a > 0 ? 1 / constants.ior : constants.ior);
  if (normal.a < 0 && reflectance == 1) reflectance = 0;  // sight goes there as the way on, as `seen` has it
  if (constants.isThinWalled != 0) reflectance = 2 * reflectance / (1 + reflectance);
  receiverPosition = receiverAlbedo = vec4(0);
  receiverNormal = vec4(vec3(0), reflectance);
  const SightRay ray = SightRay(position.xyz, reflectDirection(incident, facing));
  const float hint = isMine ? texelFetch(casterDirection, pixel, 0).a : kNoReach;
  const FoundReceiver found =
      findReceiver(ray, hint, constants.slices, constants.center, constants.reach, depths, normals);
  if (!isMine) discard;  // not before: software devices go on with the search
  if (found.distance < 0) return;
  receiverPosition = vec4(ray.origin + found.distance * ray.direction, 1);
  receiverNormal.xyz = found.normal;
  receiverAlbedo = sliceAlbedo(texelFetch(albedos, found.texel, 0).rg);
}
