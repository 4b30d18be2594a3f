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

#include "techniques/adaptive_beams/cell_lookup.glsl.h"

void main() {
  causticsLux = vec4(0);
  const ivec2 pixel = ivec2(gl_FragCoord.xy);
  const vec4 position = imageLoad(receiverPosition, pixel);
  if (position.a == 0) return;
  const vec3 normal = imageLoad(receiverNormal, pixel).xyz;
  const CellPlace cell = cellAbout(grid, position.xyz, normal);
  if (cell.tile == kNoTile) return;
  const uint inLayer = cell.tile % kTilesInLayer;
  const vec2 corner = vec2(inLayer % kTilesInRow, inLayer / kTilesInRow) * kTileStride;
  const vec2 at = corner + cell.within * kTileTexels + 1;
  const vec3 units =
      textureLod(tiles, vec3(at / vec2(kTilesInRow * kTileStride), cell.tile / kTilesInLayer), 0).rgb;
  causticsLux.rgb = units * (grid.luxOfUnit * abs(normal[cell.face / 2]));
}
