// A beam (illumination volume): the light between three outgoing rays.
#ifndef NEPHROID_BEAMS_BEAM_H
#define NEPHROID_BEAMS_BEAM_H

#include "core/shared_language.h"

SHARED_BEGIN

struct Beam {
  vec3 position[3];   // m, where its corner rays leave the caster
  vec3 direction[3];  // unit
  vec3 flux;          // lm, the same in every cross-section
  vec3 reach;         // m along each corner ray to the first opaque surface; kUnboundedReach: not known
};

// A receiver may curve between a corner ray and a point beside it. So light of the beam may arrive a little
// beyond the ray's reach: by this tolerance (m), for a point at the distance `offset` (m) from the ray.
SHARED_FUNCTION float reachTolerance(float reach, float offset) {
  return 1e-3f * reach + 0.25f * offset;
}

SHARED_END

#endif
