// Turns luminance into the values of a picture: exposed, tone-mapped, sRGB.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/luminance.glsl.h"

layout(location = 0) out vec4 picture;

void main() {
  const Luminance seen = luminanceAt(ivec2(gl_FragCoord.xy));
  const vec3 shown = displayed(seen.direct + seen.caustics + seen.rest, constants.toneMapping);
  picture = vec4(levelsOf(shown, uint(gl_FragCoord.x), uint(gl_FragCoord.y)) / 255, 1);
}
