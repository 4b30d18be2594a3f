// The outgoing ray: the result of every transport source, and the only thing that later stages know about the
// transport.
#ifndef NEPHROID_TRANSPORT_OUTGOING_RAY_H
#define NEPHROID_TRANSPORT_OUTGOING_RAY_H

#include "core/shared_language.h"

SHARED_BEGIN

// Something stands between the light and the point where it would enter.
SHARED_CONSTANT uint kRayOccluded = 1u;
// The light never leaves the caster: it is totally reflected or trapped. Position and direction are the last
// ones.
SHARED_CONSTANT uint kRayLost = 2u;

// `reach` of a ray that meets no opaque surface, or where the source does not know it (a table contains only
// the caster).
SHARED_CONSTANT float kUnboundedReach = 1e30f;

// The ray along which light leaves a caster for the last time, for light that meets the caster at one point.
// World space.
struct OutgoingRay {
  vec3 position;       // m
  float pathLength;    // m inside the caster
  vec3 direction;      // unit
  uint flags;          // kRay...; 0: the ray carries light
  vec3 transmittance;  // 0..1 per channel: Fresnel (unpolarized), absorption and mirror color
  uint signature;      // equal for rays that crossed the same sequence of smooth surfaces
  float reach;         // m from `position` to the first opaque surface
};

SHARED_END

#endif
