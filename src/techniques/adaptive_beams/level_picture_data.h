// The constants of the pass that shows the levels of landed light, for C++ and GLSL.
#ifndef NEPHROID_TECHNIQUES_ADAPTIVE_BEAMS_LEVEL_PICTURE_DATA_H
#define NEPHROID_TECHNIQUES_ADAPTIVE_BEAMS_LEVEL_PICTURE_DATA_H

#include "techniques/adaptive_beams/landed_light_data.h"

SHARED_BEGIN

struct LevelPictureConstants {
  LandedGrid grid;
  uint first;  // level, and the number of levels, that have colors of their own
  uint count;
};

SHARED_END

#endif
