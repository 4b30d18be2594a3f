// Luminance (nit) that one light's way through the air adds to each pixel: the sum over sampling planes of
// Dobashi 2002, eqs. 5 to
// 9. Rays are clipped to the light's cone and to what they meet. Planes stand at equal angles as the light
// sees them, so that the inverse square is summed exactly (Kulla and Fajardo 2012); sub-planes are used where
// the light that arrives changes.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_samplerless_texture_functions : require
#include "render/light.glsl.h"

#include "optics/phase.h"
#include "render/air/box.glsl.h"

layout(constant_id = 6) const uint kPhase = kPhaseIsotropic;
uniform texture2D depthImage;
uniform sampler2DArray boxDepths;
uniform sampler2DArray density;
layout(location = 0) flat in Air air;
layout(location = 5) flat in AirPlanes planes;
layout(location = 8) flat in vec3 eye;
layout(location = 9) flat in vec3 depths;  // nearest, pace, stride of AirSight
layout(location = 10) noperspective in vec3 ray;
layout(location = 11) flat in AirBox box;
layout(location = 0) out vec4 shafts;  // added to those of other lights

// Texels of a shadow map.
const float kMargin = 3;

// A ray of sight as a light sees it.
struct Sight {
  vec3 direction;   // unit
  vec3 origin;      // m from the light, or from the maps' aim where light comes from afar
  float closest;    // m along the ray, of the place next to the light
  float height;     // m from the light there
  vec2 part;        // m along the ray, the begin and end of the part that is computed
  float span;       // the angle of that part, as the light sees it; for light from afar what the air takes of
                    // light on that part
  float start;      // m along the ray from the closest place, where the part begins
  float startAway;  // m from the light there
  float
      lastSeen;  // m along the ray, as far as shadow maps are looked at: what ends the ray is not to shade it
  vec2 toAxis;   // along the light's direction: of `origin`, m, and of `direction`
};

struct Place {
  float along;   // m from the eye
  float away;    // m from the light
  float cosine;  // of the angle that light is turned by toward the eye
  float weight;  // m from the eye over `span`, times the inverse square of `away`
  vec2 part;     // of the span, 0 to 1; of an angle its cosine and sine
};

bool isFar() {
  return kEmitterType == kEmitterDirectional;
}

// Where the ray, its closest place at 0, runs within the spot's cone.
vec2 withinCone(float height, vec3 toClosest, vec3 direction) {
  const float cosCone = -constants.coneOffset / constants.coneScale;
  const float forward = dot(toClosest, constants.direction);
  const float approach = dot(direction, constants.direction);
  float square = approach * approach - cosCone * cosCone;
  if (abs(square) < 1e-9) square = 1e-9;
  const float inside = forward * forward + height * height * square;
  if (inside < 0) return vec2(0);
  const float linear = forward * approach;
  const float root = cosCone * sqrt(inside);
  const float stable = -(linear + (linear < 0 ? -root : root));
  const float constant = forward * forward - cosCone * cosCone * height * height;
  const float a = stable / square, b = constant / stable;
  if (square < 0) return forward > 0 ? vec2(min(a, b), max(a, b)) : vec2(0);
  return approach > 0 ? vec2(max(a, b), 2 * kFarthestAir) : vec2(-2 * kFarthestAir, min(a, b));
}

Sight sightFrom(vec3 origin, vec3 direction, float reach) {
  Sight sight;
  sight.direction = direction;
  sight.origin = eye - (isFar() ? constants.aim : origin);
  sight.part = kHasBox ? wayThroughBox(box, eye, direction, reach) : vec2(0, reach);
  if (isFar()) {
    sight.closest = sight.height = sight.start = sight.startAway = 0;
    sight.span = 1 - exp(-depths.y * (sight.part.y - sight.part.x));
    sight.lastSeen = reach - kMargin * constants.texelSize;
    sight.toAxis = vec2(0);
    return sight;
  }
  sight.closest = -dot(sight.origin, direction);
  const vec3 toClosest = sight.origin + sight.closest * direction;
  sight.height = max(length(toClosest), 1e-5);
  if (kEmitterType == kEmitterSpot && constants.coneScale > 0) {
    const vec2 cone = sight.closest + withinCone(sight.height, toClosest, direction);
    sight.part = vec2(max(cone.x, sight.part.x), min(cone.y, sight.part.y));
  }
  sight.start = sight.part.x - sight.closest;
  sight.startAway = length(vec2(sight.start, sight.height));
  const float end = sight.part.y - sight.closest;
  sight.span = atan(sight.height * (end - sight.start), sight.height * sight.height + sight.start * end);
  sight.lastSeen = reach - kMargin * constants.texelSize * length(vec2(end, sight.height));
  sight.toAxis = vec2(dot(sight.origin, constants.direction), dot(direction, constants.direction));
  return sight;
}

// Of an angle from 0 to pi, as precise as it is small; software devices take several times as long over sin
// and cos.
vec2 cosineAndSine(float angle) {
  const float halved = 0.5 * angle, square = halved * halved;
  const float sine =
      halved *
      (1 + square *
               (-1.0 / 6 +
                square * (1.0 / 120 + square * (-1.0 / 5040 + square * (1.0 / 362880 - square / 39916800)))));
  const float cosine =
      1 + square * (-0.5 +
                    square * (1.0 / 24 + square * (-1.0 / 720 + square * (1.0 / 40320 - square / 3628800))));
  return vec2(1 - 2 * sine * sine, 2 * sine * cosine);
}

Place placeOf(Sight sight, vec2 part) {
  Place place;
  place.part = part;
  if (isFar()) {
    const float left = max(1 - part.x * sight.span, 1e-30);
    place.along = min(sight.part.x - log(left) / depths.y, sight.part.y);
    place.away = 0;
    place.cosine = -dot(constants.direction, sight.direction);
    place.weight = 1 / (depths.y * left);
    return place;
  }
  const float inverse = 1 / max(sight.height * part.x - sight.start * part.y, 1e-12);
  const float fromClosest = sight.start + sight.startAway * sight.startAway * part.y * inverse;
  place.away = sight.height * sight.startAway * inverse;
  place.along = clamp(sight.closest + fromClosest, sight.part.x, sight.part.y);
  place.cosine = -fromClosest / place.away;
  place.weight = 1 / sight.height;
  return place;
}

Place placeAt(Sight sight, float part) {
  return placeOf(sight, isFar() ? vec2(part) : cosineAndSine(part * sight.span));
}

Place placeBetween(Sight sight, Place a, Place b) {
  const vec2 sum = a.part + b.part;
  return placeOf(sight, isFar() ? 0.5 * sum : normalize(sum));
}

// H: the part of the light that comes to a place.
float visibleAt(Sight sight, Place place, vec2 middle, uint firstMap) {
  return kMapCount > 0
             ? litPart(sight.origin + min(place.along, sight.lastSeen) * sight.direction, middle, firstMap)
             : 1;
}

// I_l: what the light sends to a place, as a part of its peak.
vec3 sentTo(Sight sight, Place place) {
  if (kEmitterType != kEmitterSpot && kEmitterType != kEmitterPanel) return vec3(1);
  const float inverse = 1 / place.away;
  const float cosine = (sight.toAxis.x + place.along * sight.toAxis.y) * inverse;
  if (kEmitterType == kEmitterPanel) return vec3(max(cosine, 0));
  const float part = coneFalloff(cosine, constants.coneScale, constants.coneOffset);
  if (!kHasGobo && kProfileType == kNoProfile) return vec3(part);
  return part > 0 ? part * shape((sight.origin + place.along * sight.direction) * inverse) : vec3(0);
}

// What of the light that arrives is sent to the eye, over the span: g of eq. 3. Light from afar is not
// weakened before.
float scattered(Sight sight, Place place, float lightHeight) {
  const vec3 point = eye + place.along * sight.direction;
  float dense = 1, depth;
  if (kHasBox) {
    dense = boxDensity(density, box, point);
    depth = boxDepth(boxDepths, box, point, 0);
    if (!isFar()) depth += boxDepth(boxDepths, box, point, box.firstLayer);
  } else {
    if (air.inverseFogHeight > 0) dense = fogDensity(air, point.y);
    depth = meanFogDensity(air, eye.y, point.y) * place.along;
    if (!isFar()) depth += meanFogDensity(air, lightHeight, point.y) * place.away;
  }
  return dense * phaseFunction(kPhase, air.g, place.cosine) * exp(-air.extinction * depth) * place.weight;
}

vec3 scatteredFrom(vec3 origin, vec3 direction, float reach, uint firstMap) {
  const Sight sight = sightFrom(origin, direction, reach);
  const uint size = planes.tolerance > 0 ? planes.subplanes : 1;
  const uint last = sight.part.y > sight.part.x ? planes.planes * planes.subplanes : 0;
  const vec2 middle = middleOfMap(origin);
  const float unit = 1 / float(planes.planes * planes.subplanes);
  Place start = placeAt(sight, 0);
  float visible = 0, g = 0;
  vec3 light = vec3(0), sum = vec3(0);
  uint at = 0, step = 0;
  // One place in a turn, the first included: software devices run through every branch that is written out.
  while (at < last) {
    const Place end = placeAt(sight, float(at + step) * unit);
    const float endVisible = visibleAt(sight, end, middle, firstMap);
    const vec3 endLight = endVisible * sentTo(sight, end);
    const float endG = scattered(sight, end, origin.y);
    const Place between = placeBetween(sight, start, end);
    const vec3 betweenLight = 0.5 * (visible + endVisible) * sentTo(sight, between);
    // A jump may be anywhere in the step; what is smooth Simpson's rule sums better than it is judged here.
    const vec3 bend = abs(light + endLight - 2 * betweenLight) / 3;
    const float change = max(abs(endVisible - visible) *
                                 max(light.x + light.y + light.z, endLight.x + endLight.y + endLight.z) / 3,
                             max(bend.x, max(bend.y, bend.z)));
    const bool isCut = step > 1 && change * float(step) * unit > planes.tolerance;
    // Simpson's rule.
    const vec3 mean =
        (g * light + 4 * scattered(sight, between, origin.y) * betweenLight + endG * endLight) / 6;
    sum += isCut ? vec3(0) : float(step) * mean;
    if (!isCut) start = end;
    visible = isCut ? visible : endVisible;
    light = isCut ? light : endLight;
    g = isCut ? g : endG;
    at = isCut ? at : at + step;
    step = isCut ? step >> 1 : at == 0 ? size : min(size, at & (~at + 1));
  }
  return last > 0 ? sum * (sight.span * unit) : vec3(0);
}

void main() {
  const ivec2 pixel = ivec2(floor(gl_FragCoord.xy) * depths.z + 0.5 * (depths.z - 1));
  const float depth = texelFetch(depthImage, pixel, 0).r;
  const float perMeter = length(ray);
  const float reach = depth > 0 ? depths.x / depth * perMeter : kFarthestAir;
  const vec3 direction = ray / perMeter;
  vec3 sum = vec3(0);
  if (kIsLine) {
    for (uint i = 0; i < constants.samples; ++i)
      sum +=
          scatteredFrom(constants.position + float(i) * constants.direction, direction, reach, i * kMapCount);
  } else {
    sum = scatteredFrom(constants.position, direction, reach, 0);
  }
  shafts = vec4(air.extinction * air.albedo * constants.power * sum, 0);
}
