// An image of one layer.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_samplerless_texture_functions : require
#include "techniques/show_data.h"

layout(push_constant, scalar) uniform Constants {
  ShowConstants constants;
};
uniform texture2D image;
layout(location = 0) out vec4 picture;

vec4 texelOf(ivec2 texel, int layer) {
  return texelFetch(image, texel, 0);
}

#include "viewer/show/show.glsl.h"

void main() {
  picture = shown(ivec2(gl_FragCoord.xy));
}
