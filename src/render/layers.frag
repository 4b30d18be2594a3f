// Luminance and its parts.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/luminance.glsl.h"

layout(location = 0) out vec4 luminance;
layout(location = 1) out vec4 directLuminance;
layout(location = 2) out vec4 causticsLuminance;
layout(location = 3) out vec4 airLuminance;  // of what air and water scatter

void main() {
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const Luminance seen = luminanceAt(pixel);
  luminance = vec4(seen.direct + seen.caustics + seen.rest, 1);
  directLuminance = vec4(seen.direct, 1);
  causticsLuminance = vec4(seen.caustics, 1);
  airLuminance = vec4(airAt(pixel), 1);
}
