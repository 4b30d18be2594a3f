// Luminance to sRGB by the Khronos PBR neutral tone mapper (KhronosGroup/ToneMapping): colors below its
// shoulder stay as they are, brighter ones are compressed and lose saturation.
#ifndef NEPHROID_RENDER_TONE_MAPPING_H
#define NEPHROID_RENDER_TONE_MAPPING_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_FUNCTION vec3 toneMapped(vec3 color) {
  const float shoulder = 0.8f - 0.04f;
  const float desaturation = 0.15f;
  const float low = min(color.r, min(color.g, color.b));
  color -= low < 0.08f ? low - 6.25f * low * low : 0.04f;
  const float peak = max(color.r, max(color.g, color.b));
  if (peak < shoulder) return color;
  const float room = 1.0f - shoulder;
  const float compressed = 1.0f - room * room / (peak + room - shoulder);
  const float whiteness = 1.0f - 1.0f / (desaturation * (peak - compressed) + 1.0f);
  return mix(color * (compressed / peak), vec3(compressed), whiteness);
}

// The transfer curve of IEC 61966-2-1. x^(1 / 2.4) is t^(5 / 3) of t = x^(1 / 4), interpolated at Chebyshev
// nodes: within 5e-5, a hundredth of a step of 8 bits, and several times as fast as pow in software.
SHARED_FUNCTION vec3 srgbEncoded(vec3 linear) {
  const vec3 t = sqrt(sqrt(linear));
  const vec3 power =
      -0.0095557432f + t * (0.18952950f + t * (1.0541134f + t * (-0.30657031f + t * 0.072504737f)));
  return mix(1.055f * power - 0.055f, linear * 12.92f, lessThanEqual(linear, vec3(0.0031308f)));
}

// The value (0..1, sRGB) that a screen shows for a luminance (nit).
SHARED_FUNCTION vec3 displayed(vec3 luminance, float exposure) {
  const vec3 shown = toneMapped(max(exposure * luminance, vec3(0.0f)));
  return srgbEncoded(clamp(shown, 0.0f, 1.0f));
}

SHARED_END

#endif
