// The picture of the mean of samples: exposed, tone-mapped, sRGB.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#extension GL_EXT_scalar_block_layout : require
#include "render/samples/mean_data.h"
#include "render/shown_picture.glsl.h"

layout(push_constant, scalar) uniform Constants {
  MeanConstants constants;
};
uniform texture2D luminance;  // nit, the sum
layout(location = 0) out vec4 picture;

void main() {
  const vec3 sum = texelFetch(luminance, ivec2(gl_FragCoord.xy), 0).rgb;
  picture = pictureOf(constants.part * sum, constants.exposure, gl_FragCoord);
}
