// Light where it landed: cells of an octree for each way that receivers face, each with a tile of texels
// across that way. Once for C++ and GLSL.
#ifndef NEPHROID_TECHNIQUES_ADAPTIVE_BEAMS_LANDED_LIGHT_DATA_H
#define NEPHROID_TECHNIQUES_ADAPTIVE_BEAMS_LANDED_LIGHT_DATA_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kFaces = 6u;        // +x, -x, +y, -y, +z, -z
SHARED_CONSTANT uint kTileTexels = 16u;  // along a side of a cell
SHARED_CONSTANT uint kTileStride = 18u;  // with one more about it, for interpolation
SHARED_CONSTANT uint kDeepestCell = 18u;
SHARED_CONSTANT uint kCellWords = 9u;  // eight children by the halves along x (1), y (2) and z (4), 0 where
                                       // there is none; and the tile, kNoTile without light
SHARED_CONSTANT uint kNoTile = 0xffffffffu;
SHARED_CONSTANT uint kWordsInRow = 1024u;  // of the image of cells
SHARED_CONSTANT uint kTilesInRow = 56u;    // of a layer of the image of tiles
SHARED_CONSTANT uint kTilesInLayer = 3136u;

struct LandedGrid {
  vec3 origin;      // m, where cell (0, 0, 0) of the coarsest begins
  float cellSize;   // m, of the coarsest
  uvec3 cells;      // of the coarsest, along x, y and z
  float luxOfUnit;  // lux across the face, of a texel's value of 1
};

// The face that a receiver of unit normal `n` is of.
SHARED_FUNCTION uint faceOf(vec3 n) {
  vec3 size = abs(n);
  uint axis = size.x >= size.y && size.x >= size.z ? 0u : (size.y >= size.z ? 1u : 2u);
  return 2u * axis + (n[int(axis)] < 0.0f ? 1u : 0u);
}

// Across a face: the two other axes.
SHARED_FUNCTION vec2 acrossFace(vec3 v, uint face) {
  return face < 2u ? vec2(v.y, v.z) : (face < 4u ? vec2(v.z, v.x) : vec2(v.x, v.y));
}

SHARED_FUNCTION uint rootOf(LandedGrid grid, uint face, uvec3 cell) {
  return ((face * grid.cells.z + cell.z) * grid.cells.y + cell.y) * grid.cells.x + cell.x;
}

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::LandedGrid) == 32);
#endif

#endif
