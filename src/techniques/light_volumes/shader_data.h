// Data that light volumes share between the processor and their shaders.
#ifndef NEPHROID_TECHNIQUES_LIGHT_VOLUMES_SHADER_DATA_H
#define NEPHROID_TECHNIQUES_LIGHT_VOLUMES_SHADER_DATA_H

#include "gpu/buffer_address.h"

#include "beams/beam_bounds.h"
#include "beams/footprint.h"

#ifndef __cplusplus
layout(buffer_reference, scalar) buffer LightVolumeCounts {
  uint tested;      // bounds
  uint culled;      // of these, rejected with everything inside
  uint drawn;       // beams on patches
  uint wanted;      // the largest number of draws that a list needed; 0: all lists had enough room
  uint unfinished;  // tiles that a device did not finish
};
#endif

SHARED_BEGIN

// The side (pixels) of a tile, the square of pixels of one group.
SHARED_CONSTANT uint kTileSize = 8u;
SHARED_CONSTANT uint kTilePixels = kTileSize * kTileSize;
// The side (pixels) of a block; a tile has four blocks.
SHARED_CONSTANT uint kBlockSize = 4u;
// The layout of the images that hold beams and bounds.
SHARED_CONSTANT uint kTexelsInRow = 4096u;
SHARED_CONSTANT uint kTexelsOfBounds = 4u;
SHARED_CONSTANT uint kTexelsOfBeam = 6u;
// The pixels of a tile that show nearly the same plane are a patch. The last patch has all other pixels.
SHARED_CONSTANT uint kMostPatches = 4u;

// Beams of one lamp and one caster.
struct BeamPortion {
  vec3 still;       // unit, the direction of its light through still water
  vec3 extinction;  // 1/m, of the water that its light goes through
};

// A beam on the pixels of one patch that it may light.
struct BeamDraw {
  uint beam;
  uint portion;
  uint corner;  // x and y of the first pixel, 16 bits each
  uint square;  // the pixels along a side (low 8 bits); above, the patch, as in squareV
};

// A VkDrawIndirectCommand, and the number of draws that the list needed.
struct BeamDrawCommand {
  uint vertices;
  uint instances;
  uint firstVertex;
  uint firstInstance;
  uint asked;
};

SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer BeamPortions {
  BeamPortion portion[];
};
layout(buffer_reference, scalar) buffer BeamDraws {
  BeamDraw draw[];
};
layout(buffer_reference, scalar) buffer BeamDrawCommands {
  BeamDrawCommand command;
};
#endif

SHARED_BEGIN

struct PatchConstants {
  BUFFER_ADDRESS(LightVolumeCounts) counts;
  BUFFER_ADDRESS(BeamDraws) draws;
  BUFFER_ADDRESS(BeamDrawCommands) command;
  uint room;  // draws that there is room for
  uint root;
  ivec2 corner;  // of the region, pixels
  ivec2 size;
};

struct BeamDrawConstants {
  BUFFER_ADDRESS(BeamPortions) portions;
  BUFFER_ADDRESS(BeamDraws) draws;
  vec2 imageSize;  // pixels
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::PatchConstants) == 48 && sizeof(nephroid::BeamDrawConstants) == 24 &&
              sizeof(nephroid::BeamBounds) == 64 && sizeof(nephroid::Beam) == 96);
#endif

#endif
