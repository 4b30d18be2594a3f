#ifndef NEPHROID_TECHNIQUES_LIGHT_VOLUMES_SHADER_DATA_H
#define NEPHROID_TECHNIQUES_LIGHT_VOLUMES_SHADER_DATA_H

#include "gpu/buffer_address.h"

#include "beams/beam_bounds.h"
#include "beams/footprint.h"

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer LightVolumes {
  Beam beam[];
};
layout(buffer_reference, scalar) readonly buffer LightVolumeBounds {
  BeamBounds bounds[];
};
// The way that light of a portion would go through still water.
layout(buffer_reference, scalar) readonly buffer StillDirections {
  vec4 direction[];
};
layout(buffer_reference, scalar) buffer LightVolumeCounts {
  uint tested;  // bounds
  uint culled;  // of these, with all that is in them
  uint drawn;   // beams on blocks of pixels
};
#endif

SHARED_BEGIN

// A workgroup's square of pixels.
SHARED_CONSTANT uint kTileSize = 16u;
SHARED_CONSTANT uint kThreads = 64u;

struct LightVolumeConstants {
  BUFFER_ADDRESS(LightVolumes) beams;
  BUFFER_ADDRESS(LightVolumeBounds) bounds;
  BUFFER_ADDRESS(StillDirections) still;
  BUFFER_ADDRESS(LightVolumeCounts) counts;
  uint root;
  ivec2 corner;  // of the region, pixels
  ivec2 size;
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::LightVolumeConstants) == 56 && sizeof(nephroid::BeamBounds) == 52);
#endif

#endif
