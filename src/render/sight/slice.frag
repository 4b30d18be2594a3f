// A texel of a sliced object image.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/sight/sight_data.h"

#include "render/sight/slice_texel.glsl.h"

layout(constant_id = 0) const bool kHasTexture = false;
layout(push_constant, scalar) uniform Constants {
  SliceConstants constants;
};
uniform sampler2D colorTexture;
layout(location = 0) in vec3 normal;
layout(location = 1) in vec2 texcoord;
layout(location = 0) out uint normalWord;
layout(location = 1) out uvec2 albedoWords;

void main() {
  vec3 albedo = constants.color;
  if (kHasTexture) albedo *= texture(colorTexture, texcoord).rgb;
  normalWord = packUnorm2x16(octahedralFromDirection(normalize(normal)));
  albedoWords = packSliceAlbedo(albedo, constants.material);
}
