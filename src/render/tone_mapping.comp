// Luminance to sRGB by the Khronos PBR neutral tone mapper (KhronosGroup/ToneMapping): colours below its shoulder stay as they are,
// brighter ones are compressed and lose saturation.
#version 460
#extension GL_GOOGLE_include_directive : require
#include "render/frame_data.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(push_constant, scalar) uniform Constants { ToneConstants constants; };
layout(set = 0, binding = 0, rgba32f) uniform readonly image2D luminance;
layout(set = 0, binding = 1, rgba8) uniform writeonly image2D picture;

vec3 neutral(vec3 color) {
  const float shoulder = 0.8 - 0.04;
  const float desaturation = 0.15;
  const float low = min(color.r, min(color.g, color.b));
  color -= low < 0.08 ? low - 6.25 * low * low : 0.04;
  const float peak = max(color.r, max(color.g, color.b));
  if (peak < shoulder) return color;
  const float room = 1 - shoulder;
  const float compressed = 1 - room * room / (peak + room - shoulder);
  const float whiteness = 1 - 1 / (desaturation * (peak - compressed) + 1);
  return mix(color * (compressed / peak), vec3(compressed), whiteness);
}

vec3 encoded(vec3 linear) {
  return mix(linear * 12.92, 1.055 * pow(linear, vec3(1 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}

void main() {
  const ivec2 pixel = ivec2(gl_GlobalInvocationID.xy);
  if (any(greaterThanEqual(pixel, imageSize(luminance)))) return;
  const vec3 color = max(constants.exposure * imageLoad(luminance, pixel).rgb, vec3(0));
  imageStore(picture, pixel, vec4(encoded(clamp(neutral(color), 0, 1)), 1));
}
