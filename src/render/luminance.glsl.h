// Luminance (nit) toward the viewer. Each pixel sees a receiver, or the receiver that a caster shows there,
// and the one that glass reflects. Where a caster disperses, each channel sees its own place.
#include "render/frame_data.h"

#include "render/sight/sight_data.h"

layout(constant_id = 0) const bool kHasEmission = false;  // does any receiver shine by itself
layout(constant_id = 1) const bool kSeesCasters = false;  // may one be in front of a receiver here
layout(constant_id = 2) const bool kReflects = false;     // with kSeesCasters: may glass reflect something
layout(constant_id = 3) const bool kDisperses = false;    // with kSeesCasters
layout(constant_id = 4) const bool kHasAir = false;
layout(constant_id = 5) const bool kHasTurbidWater = false;
layout(constant_id = 6) const bool kSeenByRays = false;  // with kSeesCasters: casters' pixels, by rays
layout(push_constant, scalar) uniform Constants {
  CompositeConstants constants;
};
// Of all SeenImages, by kSeen...
uniform texture2D normal[kSeenCount];
uniform texture2D albedo[kSeenCount];
uniform texture2D transmittance[kSeenCount];
uniform texture2D directLux[kSeenCount];
uniform texture2D causticsLux[kSeenCount];
// With kHasAir: rgb is the luminance of the air, a is its transmittance.
uniform texture2D shafts;
// With kHasTurbidWater: the parts of view rays in water, and the light that it scatters along them (nit).
uniform texture2D wayStart;
uniform texture2D scattered;
// With kSeenByRays, of the pixels: rgb is what they show by no light (nit), a > 0 where there is a caster;
// and the first of their points, and their number.
uniform texture2D sightRest;
uniform utexture2D sightRanges;
// Of the points, kPointsInRow in a row: luminance of the pixel for each lux (nit), and the light there.
uniform texture2D pointFactors;
uniform texture2D pointDirectLux;
uniform texture2D pointCausticsLux;

const float kInversePi = 0.318309886;

struct Luminance {
  vec3 direct;    // by light that met no caster
  vec3 caustics;  // by light that met one
  vec3 rest;      // of surfaces, the background and skies
};

Luminance luminanceOf(vec4 albedo, vec3 directLight, vec3 causticsLight) {
  if (albedo.a == 0) return Luminance(vec3(0), vec3(0), constants.background + albedo.rgb);
  const vec3 reflectance = albedo.rgb * kInversePi;  // 1/sr
  vec3 rest = reflectance * constants.ambient;
  if (kHasEmission) rest += constants.materials.material[uint(albedo.a) - 1].emission;
  return Luminance(reflectance * directLight, reflectance * causticsLight, rest);
}

// A macro, since images are chosen by constants alone.
#define LUMINANCE_OF(which, pixel)                                                             \
  luminanceOf(texelFetch(albedo[which], pixel, 0), texelFetch(directLux[which], pixel, 0).rgb, \
              texelFetch(causticsLux[which], pixel, 0).rgb)

void add(inout Luminance sum, vec3 factor, Luminance other) {
  sum.direct += factor * other.direct;
  sum.caustics += factor * other.caustics;
  sum.rest += factor * other.rest;
}

// The transmittance of the water around the eye, up to the nearest surface.
vec3 leftByWater(ivec2 pixel) {
  return kHasTurbidWater ? exp(-constants.extinctionAtEye * texelFetch(wayStart, pixel, 0).a) : vec3(1);
}

Luminance dimmed(vec3 factor, Luminance seen) {
  return Luminance(factor * seen.direct, factor * seen.caustics, factor * seen.rest);
}

Luminance seenByRays(ivec2 pixel, vec3 rest) {
  Luminance sum = Luminance(vec3(0), vec3(0), rest);
  const uvec2 range = texelFetch(sightRanges, pixel, 0).xy;
  for (uint i = range.x; i < range.x + range.y; ++i) {
    const ivec2 point = ivec2(i % kPointsInRow, i / kPointsInRow);
    const vec3 factor = texelFetch(pointFactors, point, 0).rgb;
    sum.direct += factor * texelFetch(pointDirectLux, point, 0).rgb;
    sum.caustics += factor * texelFetch(pointCausticsLux, point, 0).rgb;
  }
  return sum;
}

Luminance surfaceAt(ivec2 pixel) {
  if (kSeesCasters && kSeenByRays) {
    const vec4 rest = texelFetch(sightRest, pixel, 0);
    if (rest.a > 0) return seenByRays(pixel, rest.rgb);
    return dimmed(leftByWater(pixel), LUMINANCE_OF(kSeen, pixel));
  }
  Luminance seen = LUMINANCE_OF(kSeen, pixel);
  if (!kSeesCasters) return dimmed(leftByWater(pixel), seen);
  const vec4 through = texelFetch(transmittance[kSeen], pixel, 0);
  const uint marks = uint(through.a);
  if (marks == 0) return dimmed(leftByWater(pixel), seen);
  Luminance sum = Luminance(vec3(0), vec3(0), vec3(0));
  if (kDisperses && (marks & kSightDisperses) != 0) {
    add(sum, vec3(through.r, 0, 0), seen);
    add(sum, vec3(0, texelFetch(transmittance[kSeenGreen], pixel, 0).g, 0), LUMINANCE_OF(kSeenGreen, pixel));
    add(sum, vec3(0, 0, texelFetch(transmittance[kSeenBlue], pixel, 0).b), LUMINANCE_OF(kSeenBlue, pixel));
  } else {
    add(sum, through.rgb, seen);
  }
  if (kReflects)
    add(sum, texelFetch(normal[kSeenReflected], pixel, 0).a * leftByWater(pixel),
        LUMINANCE_OF(kSeenReflected, pixel));
  return sum;
}

// Of it, what air and water scatter.
vec3 airAt(ivec2 pixel) {
  const vec3 inWater = kHasTurbidWater ? texelFetch(scattered, pixel, 0).rgb : vec3(0);
  if (!kHasAir) return inWater;
  const vec4 air = texelFetch(shafts, pixel, 0);
  return air.rgb + air.a * inWater;
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
