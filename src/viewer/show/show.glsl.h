// Shows an image as a picture: its layers are side by side, each as large as possible. A shader defines `vec4
// texelOf(ivec2 texel, int layer)`, includes this, and calls `shown` for its pixel.
#include "render/tone_mapping.h"

vec3 colorOf(vec4 value) {
  switch (constants.meaning) {
    case kShowLight:
      return displayed(value.rgb, ToneMapping(constants.scale, kToneNeutral));
    case kShowDirection:
      return dot(value.rgb, value.rgb) > 0 ? 0.5 + 0.5 * value.rgb : vec3(0);
    case kShowPlace:
      return fract(value.rgb / constants.scale);
    case kShowDepth:
      return vec3(value.r);
    case kShowNearness: {
      const float steps = value.r > 0 ? -log2(value.r) - 8 : 16;  // doublings of a distance
      return vec3(clamp(1 - steps / 12, 0, 1));
    }
    default:
      return clamp(value.rgb, 0, 1);
  }
}

vec4 shown(ivec2 pixel) {
  const int columns = int(constants.columns);
  const int rows = (int(constants.layers) + columns - 1) / columns;
  const vec2 cell = vec2(constants.size) / vec2(columns, rows);
  const ivec2 place = min(ivec2(vec2(pixel) / cell), ivec2(columns, rows) - 1);
  const int layer = place.y * columns + place.x;
  const float enlarged = min(cell.x / float(constants.from.x), cell.y / float(constants.from.y));
  const vec2 margin = 0.5 * (cell - enlarged * vec2(constants.from));
  const vec2 texel = (vec2(pixel) + 0.5 - vec2(place) * cell - margin) / enlarged;
  if (layer >= int(constants.layers) || any(lessThan(texel, vec2(0))) ||
      any(greaterThanEqual(texel, vec2(constants.from))))
    return vec4(0.05, 0.05, 0.055, 1);
  return vec4(colorOf(texelOf(ivec2(texel), layer)), 1);
}
