// The constants of the pass that shows an image, for C++ and GLSL.
#ifndef NEPHROID_TECHNIQUES_SHOW_DATA_H
#define NEPHROID_TECHNIQUES_SHOW_DATA_H

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kShowLight = 0u;      // nit, multiplied by `scale` and tone-mapped
SHARED_CONSTANT uint kShowDirection = 1u;  // -1 to 1 as 0 to 1
SHARED_CONSTANT uint kShowPlace = 2u;      // m, a stripe for each `scale` along each axis
SHARED_CONSTANT uint kShowFactor = 3u;     // 0 to 1
SHARED_CONSTANT uint kShowDepth = 4u;      // one channel from 0 to 1
SHARED_CONSTANT uint kShowNearness =
    5u;  // `scale` (m) over the distance, of a picture's depth: by its logarithm
SHARED_CONSTANT uint kShowPicture = 6u;  // as a screen has it

struct ShowConstants {
  ivec2 size;    // pixels that are shown
  ivec2 from;    // texels of a layer
  uint columns;  // layers stand side by side in so many
  uint layers;
  uint meaning;  // kShow...
  float scale;
};

SHARED_END

#endif
