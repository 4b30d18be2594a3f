// The texel of a sliced object image, besides its depth: reflectance and material of a receiver.
#include "core/octahedral.h"

uvec2 packSliceAlbedo(vec3 albedo, uint material) {
  return uvec2(packHalf2x16(albedo.rg), (packHalf2x16(vec2(albedo.b, 0)) & 0xffffu) | (material + 1) << 16);
}

// a = material + 1
vec4 sliceAlbedo(uvec2 words) {
  return vec4(unpackHalf2x16(words.x), unpackHalf2x16(words.y & 0xffffu).x, float(words.y >> 16));
}
