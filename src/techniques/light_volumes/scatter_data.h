// The constants for light that a volume scatters toward the eye, for C++ and GLSL.
#ifndef NEPHROID_TECHNIQUES_LIGHT_VOLUMES_SCATTER_DATA_H
#define NEPHROID_TECHNIQUES_LIGHT_VOLUMES_SCATTER_DATA_H

#include "gpu/buffer_address.h"

#include "beams/light_layers.h"

SHARED_BEGIN

struct ScatterConstants {
  LayerGrid grid;
  vec3 scattering;  // nit per meter and 1/sr of what the layers' texels hold
  vec3 extinction;  // 1/m
  uint phase;       // kPhase...
  float g;
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::ScatterConstants) <= 128);
#endif

#endif
