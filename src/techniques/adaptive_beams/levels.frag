// Receivers in the colors of the levels of landed light that they read, with the borders of cells, and those
// of texels where they are seen. What has no light is gray.
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "techniques/adaptive_beams/level_picture_data.h"
#include "techniques/level_color.h"

layout(push_constant, scalar) uniform Constants {
  LevelPictureConstants constants;
};
layout(rgba32f) uniform readonly image2D receiverPosition;
layout(rgba32f) uniform readonly image2D receiverNormal;
uniform usampler2D cells;  // kCellWords of each, kWordsInRow in a row
layout(location = 0) out vec4 picture;

#include "techniques/adaptive_beams/cell_lookup.glsl.h"

const float kCellLine = 0.55, kTexelLine = 0.15;  // how dark lines are
const float kLeastLined = 4, kFullyLined = 16;    // pixels along the side of what has lines about it

// How much of a border of squares a pixel shows. `within`: 0 to 1 in a square; `pixel`: of one, in its sides.
float border(vec2 within, vec2 pixel) {
  const vec2 far = min(within, 1 - within) / max(pixel, vec2(1e-6));
  const float side = 1 / max(max(pixel.x, pixel.y), 1e-6);
  return clamp(1 - min(far.x, far.y), 0, 1) * smoothstep(kLeastLined, kFullyLined, side);
}

void main() {
  const ivec2 at = ivec2(gl_FragCoord.xy);
  const vec4 position = imageLoad(receiverPosition, at);
  const vec3 metersInPixel = fwidth(position.xyz);
  picture = vec4(0.05, 0.05, 0.055, 1);
  if (position.a == 0) return;
  const vec3 normal = imageLoad(receiverNormal, at).xyz;
  const CellPlace cell = cellAbout(constants.grid, position.xyz, normal);
  picture.rgb = vec3(0.20 + 0.05 * normal.y);
  if (cell.tile == kNoTile) return;
  picture.rgb = levelColor(cell.level - constants.first, constants.count);
  const vec2 pixel = acrossFace(metersInPixel, cell.face) / constants.grid.cellSize * float(1u << cell.level);
  const float ofTexels = border(fract(cell.within * kTileTexels), pixel * kTileTexels);
  picture.rgb *= 1 - max(kCellLine * border(cell.within, pixel), kTexelLine * ofTexels);
}
