// What a texel of a sliced object image holds of a receiver, in four words.
#include "core/octahedral.h"

uvec4 packSliceTexel(vec3 normal, vec3 albedo, uint material, float depth) {
  return uvec4(packUnorm2x16(octahedralFromDirection(normal)), packHalf2x16(albedo.rg),
               (packHalf2x16(vec2(albedo.b, 0)) & 0xffffu) | (material + 1) << 16, floatBitsToUint(depth));
}

vec3 sliceNormal(uvec4 texel) {
  return directionFromOctahedral(unpackUnorm2x16(texel.x));
}

// a = material + 1
vec4 sliceAlbedo(uvec4 texel) {
  return vec4(unpackHalf2x16(texel.y), unpackHalf2x16(texel.z & 0xffffu).x, float(texel.z >> 16));
}

float sliceDepth(uvec4 texel) {
  return uintBitsToFloat(texel.w);
}
