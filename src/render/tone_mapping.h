// Luminance to the bytes of a picture, for C++ and GLSL: exposure, a tone curve, sRGB, and a pattern that
// keeps even slopes of light free of bands.
#ifndef NEPHROID_RENDER_TONE_MAPPING_H
#define NEPHROID_RENDER_TONE_MAPPING_H

#include "core/shared_language.h"

SHARED_BEGIN

// As ToneCurve.
SHARED_CONSTANT uint kToneNeutral = 0u;
SHARED_CONSTANT uint kToneAgx = 1u;
SHARED_CONSTANT uint kToneAces = 2u;
SHARED_CONSTANT uint kToneLinear = 3u;

struct ToneMapping {
  float exposure;  // multiplies luminance (nit)
  uint curve;      // kTone...
};

// The Khronos PBR neutral tone mapper (KhronosGroup/ToneMapping): colors below its shoulder stay as they
// are, but for 0.04, brighter ones are compressed and lose saturation.
SHARED_FUNCTION vec3 neutralToneMapped(vec3 color) {
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

// AgX (Sobotka), in the primaries of Rec. 2020 as Blender and Filament have it, its curve by the polynomial
// of Wrensch ("Minimal AgX implementation"). The matrices are written column by column; those of the inset
// and of Rec. 709 to 2020 stand apart, as they are published.
SHARED_FUNCTION vec3 agxToneMapped(vec3 color) {
  const mat3 toRec2020 =
      mat3(0.6274f, 0.0691f, 0.0164f, 0.3293f, 0.9195f, 0.0880f, 0.0433f, 0.0113f, 0.8956f);
  const mat3 toRec709 =
      mat3(1.6605f, -0.1246f, -0.0182f, -0.5876f, 1.1329f, -0.1006f, -0.0728f, -0.0083f, 1.1187f);
  const mat3 inset = mat3(0.856627153f, 0.137318973f, 0.111898213f, 0.0951212405f, 0.761241991f,
                          0.0767994186f, 0.0482516061f, 0.101439036f, 0.811302368f);
  const mat3 outset = mat3(1.12710058f, -0.141329763f, -0.141329763f, -0.110606643f, 1.15782370f,
                           -0.110606643f, -0.0164939387f, -0.0164939387f, 1.25193641f);
  const float leastStops = -12.47393f, mostStops = 4.026069f;  // log2 of what is black, and white
  const vec3 stops = log2(max(inset * (toRec2020 * color), vec3(1e-10f)));
  const vec3 x = clamp((stops - leastStops) / (mostStops - leastStops), 0.0f, 1.0f);
  const vec3 x2 = x * x, x4 = x2 * x2;
  const vec3 curve = 15.5f * x4 * x2 - 40.14f * x4 * x + 31.96f * x4 - 6.868f * x2 * x + 0.4298f * x2 +
                     0.1191f * x - 0.00232f;
  return toRec709 * pow(max(outset * curve, vec3(0.0f)), vec3(2.2f));
}

// The fit of ACES' RRT and ODT by Hill (BakingLab), brighter by 1 / 0.6 as three.js and the Khronos sample
// viewer have it.
SHARED_FUNCTION vec3 acesToneMapped(vec3 color) {
  const mat3 toAces =
      mat3(0.59719f, 0.07600f, 0.02840f, 0.35458f, 0.90834f, 0.13383f, 0.04823f, 0.01566f, 0.83777f);
  const mat3 fromAces =
      mat3(1.60475f, -0.10208f, -0.00327f, -0.53108f, 1.10813f, -0.07276f, -0.07367f, -0.00605f, 1.07602f);
  const vec3 v = toAces * (color / 0.6f);
  const vec3 a = v * (v + 0.0245786f) - 0.000090537f;
  const vec3 b = v * (0.983729f * v + 0.4329510f) + 0.238081f;
  return fromAces * (a / b);
}

// Linear Rec. 709 (0..1) of a screen.
SHARED_FUNCTION vec3 toneMapped(vec3 color, uint curve) {
  vec3 shown = color;
  if (curve == kToneNeutral) shown = neutralToneMapped(color);
  if (curve == kToneAgx) shown = agxToneMapped(color);
  if (curve == kToneAces) shown = acesToneMapped(color);
  return clamp(shown, 0.0f, 1.0f);
}

// The transfer curve of IEC 61966-2-1. x^(1 / 2.4) is t^(5 / 3) of t = x^(1 / 4), interpolated at Chebyshev
// nodes: within 5e-5, a hundredth of a step of 8 bits, and several times as fast as pow in software.
SHARED_FUNCTION vec3 srgbEncoded(vec3 linear) {
  const vec3 t = sqrt(sqrt(linear));
  const vec3 power =
      -0.0095557432f + t * (0.18952950f + t * (1.0541134f + t * (-0.30657031f + t * 0.072504737f)));
  return mix(1.055f * power - 0.055f, linear * 12.92f, lessThanEqual(linear, vec3(0.0031308f)));
}

// What is brighter, or infinite, is shown as if it were this.
SHARED_CONSTANT float kBrightest = 1e15f;

// The value (0..1, sRGB) that a screen shows for a luminance (nit). What is no number is black.
SHARED_FUNCTION vec3 displayed(vec3 luminance, ToneMapping mapping) {
  const vec3 exposed = min(max(vec3(0.0f), mapping.exposure * luminance), vec3(kBrightest));
  return min(srgbEncoded(toneMapped(exposed, mapping.curve)), vec3(1.0f));
}

// What is added to a level (0..255) before its fraction is cut off: 0 to 1, even over neighboring pixels, the
// same for all channels, so that gray stays gray. A lattice of rank 1 by the plastic number (Roberts, "The
// unreasonable effectiveness of quasirandom sequences", 2018), in whole numbers, which are the same
// everywhere. Levels that are whole stay as they are: black and white are not speckled.
SHARED_FUNCTION float ditherAt(uint column, uint row) {
  const uint place = 3242174889u * column + 2447445414u * row;  // 2^32 times the lattice's steps
  return float(place >> 8u) / 16777216.0f;
}

// The levels (whole, 0..255) of a displayed value in a pixel.
SHARED_FUNCTION vec3 levelsOf(vec3 shown, uint column, uint row) {
  return min(floor(255.0f * shown + ditherAt(column, row)), vec3(255.0f));
}

SHARED_END

#endif
