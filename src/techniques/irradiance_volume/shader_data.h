// The data of this folder's shaders.
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

// One light sample's part of the light of one emitter through one caster.
struct VolumeConstants {
  vec4 turn;             // quaternion, from the world to the volume; its squared length is places per meter
  vec3 origin;           // of the world, in places
  vec3 center;           // m, of the region
  float inverseRadius;   // 1/m, of the region
  vec3 lux;              // of the light that falls on the caster, times the share
  uint sizeAcross;       // of the volume: x in the lower 16 bits, y above
  uint sizeAndFlowSide;  // z in the lower 16 bits, FlowView::side above; the highest bit: kIsMirrored
  vec3 source;           // as SampleLayout has it, turned to the world
  BUFFER_ADDRESS(VolumeWords) words;  // of bricks; of shells, what the cells come after
  vec3 flowOrigin;                    // FlowView::origin
  vec3 flowScale;
  vec3 nearness;  // 1/m, of the lamp, as nearScale has it
};

// The volume is also reflected through its center.
SHARED_CONSTANT uint kIsMirrored = 0x80000000u;

SHARED_FUNCTION vec3 turned(vec3 v, vec4 turn) {
  vec3 axis = vec3(turn.x, turn.y, turn.z);
  return (turn.w * turn.w - dot(axis, axis)) * v + 2.0f * dot(axis, v) * axis +
         2.0f * turn.w * cross(axis, v);
}

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::VolumeConstants) == 128);
#endif

#endif
