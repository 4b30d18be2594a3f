// Finds the cell of landed light that a receiver's point reads: the finest about it. A shader declares
// `uniform usampler2D cells` (kCellWords of each cell, kWordsInRow in a row) and includes this.

uint cellWord(uint index) {
  return texelFetch(cells, ivec2(index % kWordsInRow, index / kWordsInRow), 0).x;
}

struct CellPlace {
  uint face;
  uint level;   // halvings of the coarsest cells
  uint tile;    // kNoTile without light
  vec2 within;  // 0 to 1 across the face
};

CellPlace cellAbout(LandedGrid grid, vec3 position, vec3 normal) {
  CellPlace found = CellPlace(faceOf(normal), 0, kNoTile, vec2(0));
  const vec3 place = (position - grid.origin) / grid.cellSize;
  if (any(lessThan(place, vec3(0))) || any(greaterThanEqual(place, vec3(grid.cells)))) return found;
  uint cell = rootOf(grid, found.face, uvec3(place));
  vec3 within = fract(place);
  for (; found.level < kDeepestCell + 4; ++found.level) {
    const uvec3 upper = uvec3(greaterThanEqual(within, vec3(0.5)));
    const uint child = cellWord(cell * kCellWords + (upper.x | upper.y << 1 | upper.z << 2));
    if (child == 0) break;
    cell = child;
    within = fract(2 * within);
  }
  found.tile = cellWord(cell * kCellWords + 8);
  found.within = acrossFace(within, found.face);
  return found;
}
