// Turns luminance into the values of a picture: exposed, tone-mapped, sRGB.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/luminance.glsl.h"
#include "render/shown_picture.glsl.h"

layout(location = 0) out vec4 picture;

void main() {
  const Luminance seen = luminanceAt(ivec2(gl_FragCoord.xy));
  picture = pictureOf(seen.direct + seen.caustics + seen.rest, constants.exposure, gl_FragCoord);
}
