// The receiver that is seen through glass, or in a mirror, in place of the one behind it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/sight/sight_data.h"

#include "render/sight/find_receiver.glsl.h"

layout(push_constant, scalar) uniform Constants {
  SightConstants constants;
};
uniform texture2D casterPosition;
uniform texture2D casterExit;
uniform texture2D casterDirection;
uniform texture2DArray depths;
uniform utexture2DArray normals;
uniform utexture2DArray albedos;
uniform utexture2D casterReceiver;
layout(location = 0) out vec4 receiverPosition;
layout(location = 1) out vec4 receiverNormal;
layout(location = 2) out vec4 receiverAlbedo;

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const bool isMine = texelFetch(casterPosition, pixel, 0).a == float(constants.number);
  const vec4 exit = texelFetch(casterExit, pixel, 0);
  const SightRay ray = SightRay(exit.xyz, normalize(texelFetch(casterDirection, pixel, 0).xyz));
  receiverPosition = receiverNormal = receiverAlbedo = vec4(0);
  const FoundReceiver found = findReceiver(ray, isMine ? exit.a : kNoReach, constants.slices,
                                           constants.center, constants.reach, depths, normals);
  if (!isMine) discard;  // not before: software devices go on with the search
  if (found.distance < 0) {
    // Hidden in the images, by another receiver: it is near where the corners' rays ended.
    const uvec4 known = texelFetch(casterReceiver, pixel, 0);
    if (known.a == 0) return;
    receiverPosition = vec4(ray.origin + exit.a * ray.direction, 1);
    receiverNormal = vec4(directionFromOctahedral(unpackUnorm2x16(known.r)), 0);
    receiverAlbedo = sliceAlbedo(known.gb);
    return;
  }
  receiverPosition = vec4(ray.origin + found.distance * ray.direction, 1);
  receiverNormal = vec4(found.normal, 0);
  receiverAlbedo = sliceAlbedo(texelFetch(albedos, found.texel, 0).rg);
}
