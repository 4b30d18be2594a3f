// A beam (illumination volume): the light between three outgoing rays.
#ifndef NEPHROID_BEAMS_BEAM_H
#define NEPHROID_BEAMS_BEAM_H

#include "core/shared_language.h"

SHARED_BEGIN

struct Beam {
  vec3 position[3];   // m, where its corner rays leave the caster
  vec3 direction[3];  // unit
  vec3 flux;          // lm it carries, the same through every cross-section
  vec3 reach;         // m along each corner ray to the first opaque surface; kUnboundedReach: not known
};

// m past the reach of a corner ray that is still on the surface it met there, for a point `offset` m off the
// ray: surfaces bend between one and the other.
SHARED_FUNCTION float reachTolerance(float reach, float offset) {
  return 1e-3f * reach + 0.25f * offset;
}

SHARED_END

#endif
