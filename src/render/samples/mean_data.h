// The constants of the pass that makes a picture of a sum of samples, for C++ and GLSL.
#ifndef NEPHROID_RENDER_SAMPLES_MEAN_DATA_H
#define NEPHROID_RENDER_SAMPLES_MEAN_DATA_H

#include "render/tone_mapping.h"

SHARED_BEGIN

struct MeanConstants {
  float part;  // 1 over the number of samples
  ToneMapping toneMapping;
};

SHARED_END

#endif
