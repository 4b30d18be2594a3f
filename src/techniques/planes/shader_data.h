// The data of this folder's shaders.
#ifndef NEPHROID_TECHNIQUES_PLANES_SHADER_DATA_H
#define NEPHROID_TECHNIQUES_PLANES_SHADER_DATA_H

#include "gpu_scene/scene_data.h"

#include "beams/plane_set.h"
#include "transport/outgoing_ray.h"

SHARED_BEGIN

// A footprint with more than kWideFootprint texels along a side is drawn into the coarse copy where its
// illuminance is less than kDimFootprint times the mean of the inner window.
SHARED_CONSTANT float kWideFootprint = 24.0f;
SHARED_CONSTANT float kDimFootprint = 0.01f;

SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer Beams {
  Beam beam[];
};
#endif

SHARED_BEGIN

// The planes are in the push constants because a software device reads those once for all threads.
struct DepositConstants {
  PlaneSet set;
  BUFFER_ADDRESS(Beams) beams;
  uint beamCount;
  float textureSize;
};

struct ViewConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  vec4 toClip[3];  // rows of the affine map from world space
  vec3 axisU;      // of the planes
  vec3 axisV;
  vec3 axisW;
  uint object;
};

struct ShadeConstants {
  PlaneSet set;
  float textureSize;
};

SHARED_END

#endif
