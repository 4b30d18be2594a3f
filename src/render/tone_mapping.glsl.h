// Luminance to sRGB by the Khronos PBR neutral tone mapper (KhronosGroup/ToneMapping): colours below its shoulder stay as they are,
// brighter ones are compressed and lose saturation.

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

// The transfer curve of IEC 61966-2-1.
vec3 srgbEncoded(vec3 linear) {
  return mix(linear * 12.92, 1.055 * pow(linear, vec3(1 / 2.4)) - 0.055, greaterThan(linear, vec3(0.0031308)));
}
