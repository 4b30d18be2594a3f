// Luminance to sRGB by the Khronos PBR neutral tone mapper (KhronosGroup/ToneMapping): colours below its
// shoulder stay as they are, brighter ones are compressed and lose saturation.

vec3 toneMapped(vec3 color) {
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

// The transfer curve of IEC 61966-2-1. x^(1 / 2.4) is t^(5 / 3) of t = x^(1 / 4), interpolated at Chebyshev
// nodes: within 5e-5, a hundredth of a step of 8 bits, and several times as fast as pow in software.
vec3 srgbEncoded(vec3 linear) {
  const vec3 t = sqrt(sqrt(linear));
  const vec3 power = -0.0095557432 + t * (0.18952950 + t * (1.0541134 + t * (-0.30657031 + t * 0.072504737)));
  return mix(1.055 * power - 0.055, linear * 12.92, lessThanEqual(linear, vec3(0.0031308)));
}
