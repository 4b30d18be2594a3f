// What the shaders of this folder are given.
#ifndef NEPHROID_TECHNIQUES_IRRADIANCE_VOLUME_SHADER_DATA_H
#define NEPHROID_TECHNIQUES_IRRADIANCE_VOLUME_SHADER_DATA_H

#include "gpu/buffer_address.h"

#include "core/shared_language.h"

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer VolumeWords {
  uint word[];
};
#endif

SHARED_BEGIN

// One light sample's share in the light of one emitter through one caster.
struct VolumeConstants {
  vec4 toPlaces[3];      // rows of the affine map from the world to places of the volume; without shear
  vec3 centre;           // m, of the region
  float inverseRadius;   // 1/m, of the region
  vec3 lux;              // of the light that falls on the caster, times the share
  uint sizeAcross;       // of the volume: x in the lower 16 bits, y above
  uint sizeAndFlowSide;  // z in the lower 16 bits, FlowView::side above
  vec3 source;           // as SampleLayout has it, turned to the world
  BUFFER_ADDRESS(VolumeWords) words;  // of bricks; of shells, what the cells come after
  vec3 flowOrigin;                    // FlowView::origin
  vec3 flowScale;
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::VolumeConstants) == 128);
#endif

#endif
