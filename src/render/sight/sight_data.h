// The data of the passes that draw the view through glass and in mirrors, for C++ and GLSL.
#ifndef NEPHROID_RENDER_SIGHT_SIGHT_DATA_H
#define NEPHROID_RENDER_SIGHT_SIGHT_DATA_H

#include "gpu_scene/scene_data.h"

SHARED_BEGIN

// A vertex of a caster's surface that the viewer sees, and the point where the view ray through it leaves the
// caster for the last time (Iwasaki 2005, 5.3). World space.
struct SightVertex {
  vec3 position;   // m
  vec3 normal;     // unit
  vec3 exit;       // m
  vec3 direction;  // unit
  vec3 transmittance;
  float reach;           // m from `exit` to the receiver that is met, or kNoReach
  float reflectedReach;  // the same from `position`, for what is reflected there
  // The receiver at `reach`, used where the images do not contain it.
  vec3 receiverNormal;  // unit
  vec3 receiverColor;   // reflectance
  uint receiverMaterial;
  float isReceiverKnown;  // 0 or 1
};

// A square pyramid of view.
struct SightFrame {
  vec3 apex;    // m
  vec3 axisU;   // unit, along a row of texels
  vec3 axisV;   // unit, down the rows
  vec3 axisW;   // unit, the axis of the pyramid
  float scale;  // 1 over the tangent of half its opening
};

// The sliced object images of a caster: the nearest receiver on each line from the apex, in layers between
// sample planes across axisW, each plane `depthRatio` times as far as the one before it.
struct SliceSet {
  SightFrame frame;
  float firstDepth;  // m along axisW from the apex, of the first plane
  float depthRatio;
  uint slices;
  uint occupied;  // bit i: there may be a receiver in slice i
};

// Layers of the images of receivers: slices, then the faces of a cube around the caster, which take up as
// many texels along a side.
SHARED_CONSTANT uint kMostSlices = 16u;
SHARED_CONSTANT uint kSurroundingSize = 256u;

// `reach` of a vertex whose ray meets no receiver.
SHARED_CONSTANT float kNoReach = -1.0f;

// Layers overlap by this part of their depth, so that a surface has no seam where it goes through a plane.
SHARED_CONSTANT float kSliceOverlap = 0.15f;

// The range of depths (m along axisW) of a slice whose first plane is at `nearDepth`.
SHARED_FUNCTION vec2 depthsOfSlice(SliceSet set, float nearDepth) {
  return vec2(nearDepth * (1.0f - kSliceOverlap), nearDepth * set.depthRatio * (1.0f + kSliceOverlap));
}

// The range of depths (m) of the images around a caster. `reach`: m, the farthest receiver.
SHARED_FUNCTION vec2 depthsAround(float reach) {
  return vec2(1e-4f * reach, 1.01f * reach);
}

// Depth images are reversed: 1 at the nearer depth, 0 at the farther, where there is nothing.
SHARED_FUNCTION float depthFromImage(float value, vec2 depths) {
  return depths.x * depths.y / (value * (depths.y - depths.x) + depths.x);
}

// In the images of receivers around a caster: the frame of a face of the cube, as the axes of the world.
// Faces look along +x, -x, +y, -y, +z, -z.
SHARED_FUNCTION SightFrame faceOfCube(vec3 center, uint face) {
  uint axis = face / 2u;
  SightFrame frame;
  frame.apex = center;
  frame.axisW = vec3(axis == 0u ? 1.0f : 0.0f, axis == 1u ? 1.0f : 0.0f, axis == 2u ? 1.0f : 0.0f);
  if (face % 2u == 1u) frame.axisW = -frame.axisW;
  frame.axisU = vec3(axis == 0u ? 0.0f : 1.0f, axis == 0u ? 1.0f : 0.0f, 0.0f);
  frame.axisV = vec3(0.0f, axis == 2u ? 1.0f : 0.0f, axis == 2u ? 0.0f : 1.0f);
  frame.scale = 1.0f;
  return frame;
}

// Constants of the pass that draws the receivers in a pyramid between two depths.
struct SliceConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  SightFrame frame;
  vec2 depths;  // m along axisW
  float part;   // of the image's width and height, from its first texel, that is drawn to
  vec3 color;   // reflectance
  uint object;
  uint material;
};

SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer SightVertices {
  SightVertex vertex[];
};
layout(buffer_reference, scalar) readonly buffer SightCamera {
  mat4 worldToClip;
};
#endif

SHARED_BEGIN

// Constants of the pass that draws a caster with its view rays.
struct CasterConstants {
  BUFFER_ADDRESS(SightVertices) vertices;
  BUFFER_ADDRESS(SightCamera) camera;
  uint number;  // of the caster: its object + 1
  uint marks;   // kSight...
};

// Constants of the pass that finds where the view rays of a caster end.
struct SightConstants {
  SliceSet slices;
  vec3 center;  // m, of the caster: the surroundings are seen from there
  float reach;  // m, the largest distance of a receiver from the center
  vec3 eye;     // m
  float ior;    // of a dielectric, in the middle channel
  uint number;  // of the caster: its object + 1
  uint isThinWalled;
};

// The marks of a pixel, in the a channel of its transmittance.
SHARED_CONSTANT uint kSightCaster = 1u;
SHARED_CONSTANT uint kSightDisperses = 2u;

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::SightVertex) == 100 && sizeof(nephroid::SliceConstants) <= 128 &&
              sizeof(nephroid::SightConstants) <= 128);
#endif

#endif
