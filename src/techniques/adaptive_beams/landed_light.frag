// Adds the light that landed at receiver points: of the finest cell about each, which holds all of it.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/adaptive_beams/landed_light_data.h"

layout(push_constant, scalar) uniform Constants {
  LandedGrid grid;
};
layout(rgba32f) uniform readonly image2D receiverPosition;
layout(rgba32f) uniform readonly image2D receiverNormal;
uniform usampler2D cells;      // kCellWords of each, kWordsInRow in a row
uniform sampler2DArray tiles;  // kTilesInLayer in a layer
layout(location = 0) out vec4 causticsLux;

uint cellWord(uint index) {
  return texelFetch(cells, ivec2(index % kWordsInRow, index / kWordsInRow), 0).x;
}

void main() {
  causticsLux = vec4(0);
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 position = imageLoad(receiverPosition, pixel);
  if (position.a == 0) return;
  const vec3 place = (position.xyz - grid.origin) / grid.cellSize;
  if (any(lessThan(place, vec3(0))) || any(greaterThanEqual(place, vec3(grid.cells)))) return;
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  const uint face = faceOf(normal);
  uint cell = rootOf(grid, face, uvec3(place));
  vec3 within = fract(place);
  for (uint level = 0; level < kDeepestCell + 4; ++level) {
    const uvec3 upper = uvec3(greaterThanEqual(within, vec3(0.5)));
    const uint child = cellWord(cell * kCellWords + (upper.x | upper.y << 1 | upper.z << 2));
    if (child == 0) break;
    cell = child;
    within = fract(2 * within);
  }
  const uint tile = cellWord(cell * kCellWords + 8);
  if (tile == kNoTile) return;
  const uint inLayer = tile % kTilesInLayer;
  const vec2 corner = vec2(inLayer % kTilesInRow, inLayer / kTilesInRow) * kTileStride;
  const vec2 at = corner + acrossFace(within, face) * kTileTexels + 1;
  const vec3 units =
      textureLod(tiles, vec3(at / vec2(kTilesInRow * kTileStride), tile / kTilesInLayer), 0).rgb;
  causticsLux.rgb = units * (grid.luxOfUnit * abs(normal[face / 2]));
}
