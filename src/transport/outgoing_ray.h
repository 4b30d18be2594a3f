// How a caster passes light on: what every transport source answers, and all that comes after it knows.
#ifndef NEPHROID_TRANSPORT_OUTGOING_RAY_H
#define NEPHROID_TRANSPORT_OUTGOING_RAY_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kRayOccluded =
    1u;  // something stands between the light and the point where it would enter
SHARED_CONSTANT uint kRayLost =
    2u;  // never transmitted: totally reflected or trapped; position and direction are its last

// `reach` of a ray that meets no opaque surface, or whose source does not know (a table knows the caster
// alone).
SHARED_CONSTANT float kUnboundedReach = 1e30f;

// Where and how light that meets a caster at one point of its surface leaves it for the last time. World
// space.
struct OutgoingRay {
  vec3 position;       // m
  float pathLength;    // m inside the caster
  vec3 direction;      // unit
  uint flags;          // kRay...; 0: the ray carries light
  vec3 transmittance;  // Fresnel (unpolarised), absorption and mirror colour together
  uint signature;      // equal for rays that crossed the same sequence of smooth surfaces
  float reach;         // m from `position` to the first opaque surface
};

SHARED_END

#endif
