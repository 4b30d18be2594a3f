// Luminance (nit) toward the viewer, from what each pixel sees and the light there: the receiver, or what a
// caster shows in its place, and what glass reflects. Where a caster disperses, each channel sees a place of
// its own.
#include "render/frame_data.h"

#include "render/sight/sight_data.h"

layout(constant_id = 0) const bool kHasEmission = false;  // does any receiver shine by itself
layout(constant_id = 1) const bool kSeesCasters = false;  // may one be in front of a receiver here
layout(constant_id = 2) const bool kReflects = false;     // with kSeesCasters: may glass reflect something
layout(constant_id = 3) const bool kDisperses = false;    // with kSeesCasters
layout(constant_id = 4) const bool kHasAir = false;
layout(constant_id = 5) const bool kHasTurbidWater = false;
layout(push_constant, scalar) uniform Constants {
  CompositeConstants constants;
};
layout(set = 0, binding = 0) uniform texture2D receiverAlbedo;
layout(set = 0, binding = 1) uniform texture2D directLux;
layout(set = 0, binding = 2) uniform texture2D causticsLux;
layout(set = 0, binding = 3) uniform texture2D throughCaster;
layout(set = 0, binding = 4) uniform texture2D reflectedAlbedo;
layout(set = 0, binding = 5) uniform texture2D reflectedNormal;
layout(set = 0, binding = 6) uniform texture2D reflectedDirectLux;
layout(set = 0, binding = 7) uniform texture2D reflectedCausticsLux;
layout(set = 0, binding = 8) uniform texture2D greenAlbedo;
layout(set = 0, binding = 9) uniform texture2D greenDirectLux;
layout(set = 0, binding = 10) uniform texture2D greenCausticsLux;
layout(set = 0, binding = 11) uniform texture2D greenThroughCaster;
layout(set = 0, binding = 12) uniform texture2D blueAlbedo;
layout(set = 0, binding = 13) uniform texture2D blueDirectLux;
layout(set = 0, binding = 14) uniform texture2D blueCausticsLux;
layout(set = 0, binding = 15) uniform texture2D blueThroughCaster;
// With kHasAir: luminance of the air, and a the part of what is behind it that it lets through.
layout(set = 0, binding = 16) uniform texture2D shafts;
// With kHasTurbidWater: ways of sight in water, and what that scatters along them (nit).
layout(set = 0, binding = 17) uniform texture2D wayStart;
layout(set = 0, binding = 18) uniform texture2D scattered;

const float kInversePi = 0.318309886;

struct Luminance {
  vec3 direct;    // by light that met no caster
  vec3 caustics;  // by light that met one
  vec3 rest;      // of surfaces and the background
};

Luminance luminanceOf(vec4 albedo, vec3 directLight, vec3 causticsLight) {
  if (albedo.a == 0) return Luminance(vec3(0), vec3(0), constants.background);
  const vec3 reflectance = albedo.rgb * kInversePi;  // 1/sr
  vec3 rest = reflectance * constants.ambient;
  if (kHasEmission) rest += constants.materials.material[uint(albedo.a) - 1].emission;
  return Luminance(reflectance * directLight, reflectance * causticsLight, rest);
}

void add(inout Luminance sum, vec3 factor, Luminance other) {
  sum.direct += factor * other.direct;
  sum.caustics += factor * other.caustics;
  sum.rest += factor * other.rest;
}

// Past the water that the eye is in, as far as the nearest surface.
vec3 leftByWater(ivec2 pixel) {
  return kHasTurbidWater ? exp(-constants.extinctionAtEye * texelFetch(wayStart, pixel, 0).a) : vec3(1);
}

Luminance dimmed(vec3 factor, Luminance seen) {
  return Luminance(factor * seen.direct, factor * seen.caustics, factor * seen.rest);
}

Luminance surfaceAt(ivec2 pixel) {
  Luminance seen = luminanceOf(texelFetch(receiverAlbedo, pixel, 0), texelFetch(directLux, pixel, 0).rgb,
                               texelFetch(causticsLux, pixel, 0).rgb);
  if (!kSeesCasters) return dimmed(leftByWater(pixel), seen);
  const vec4 through = texelFetch(throughCaster, pixel, 0);
  const uint marks = uint(through.a);
  if (marks == 0) return dimmed(leftByWater(pixel), seen);
  Luminance sum = Luminance(vec3(0), vec3(0), vec3(0));
  if (kDisperses && (marks & kSightDisperses) != 0) {
    add(sum, vec3(through.r, 0, 0), seen);
    add(sum, vec3(0, texelFetch(greenThroughCaster, pixel, 0).g, 0),
        luminanceOf(texelFetch(greenAlbedo, pixel, 0), texelFetch(greenDirectLux, pixel, 0).rgb,
                    texelFetch(greenCausticsLux, pixel, 0).rgb));
    add(sum, vec3(0, 0, texelFetch(blueThroughCaster, pixel, 0).b),
        luminanceOf(texelFetch(blueAlbedo, pixel, 0), texelFetch(blueDirectLux, pixel, 0).rgb,
                    texelFetch(blueCausticsLux, pixel, 0).rgb));
  } else {
    add(sum, through.rgb, seen);
  }
  if (kReflects)
    add(sum, texelFetch(reflectedNormal, pixel, 0).a * leftByWater(pixel),
        luminanceOf(texelFetch(reflectedAlbedo, pixel, 0), texelFetch(reflectedDirectLux, pixel, 0).rgb,
                    texelFetch(reflectedCausticsLux, pixel, 0).rgb));
  return sum;
}

// Dobashi 2002, eq. 1.
Luminance luminanceAt(ivec2 pixel) {
  Luminance surface = surfaceAt(pixel);
  if (kHasTurbidWater) surface.rest += texelFetch(scattered, pixel, 0).rgb;
  if (!kHasAir) return surface;
  const vec4 air = texelFetch(shafts, pixel, 0);
  surface = dimmed(vec3(air.a), surface);
  surface.rest += air.rgb;
  return surface;
}
