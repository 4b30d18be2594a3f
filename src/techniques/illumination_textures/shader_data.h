// What the shaders of this folder are given.
#ifndef NEPHROID_TECHNIQUES_ILLUMINATION_TEXTURES_SHADER_DATA_H
#define NEPHROID_TECHNIQUES_ILLUMINATION_TEXTURES_SHADER_DATA_H

#include "techniques/scene_data.h"

#include "techniques/illumination_textures/plane_set.h"

SHARED_BEGIN

// Units of flux are whole numbers, so that sums do not depend on the order of the beams. All the flux of a
// set is 2^29 units: there is room for what the cosines add where light crosses the planes obliquely.
SHARED_CONSTANT float kUnitsOfAllFlux = 536870912.0f;
// Beams farther than this from the mean direction (as a cosine, 75.5 degrees) run along the planes rather
// than through them.
SHARED_CONSTANT float kLeastApproach = 0.25f;
// Threads that deposit one beam.
SHARED_CONSTANT uint kThreadsOfBeam = 8u;

SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer Beams {
  Beam beam[];
};
layout(buffer_reference, scalar) readonly buffer ReceiverNormals {
  uint word[];
};
layout(buffer_reference, scalar) buffer FluxUnits {
  uint units[];
};
#endif

SHARED_BEGIN

// The planes travel with the push constants: a software device reads those once for all threads.
struct DepositConstants {
  PlaneSet set;
  BUFFER_ADDRESS(Beams) beams;
  BUFFER_ADDRESS(ReceiverNormals) normals;  // of the window
  BUFFER_ADDRESS(FluxUnits) textures;
  uint beamCount;
  uint window;
};

struct ViewConstants {
  PlaneSet set;
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  uint object;
  uint window;
};

struct ShadeConstants {
  PlaneSet set;
  BUFFER_ADDRESS(FluxUnits) textures;
};

SHARED_END

#endif
