// The constants of the pass that makes a picture of a sum of samples, for C++ and GLSL.
#ifndef NEPHROID_RENDER_SAMPLES_MEAN_DATA_H
#define NEPHROID_RENDER_SAMPLES_MEAN_DATA_H

#include "core/shared_language.h"

SHARED_BEGIN

struct MeanConstants {
  float part;  // 1 over the number of samples
  float exposure;
};

SHARED_END

#endif
