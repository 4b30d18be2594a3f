// What the frame's passes are told, for C++ and GLSL. Sizes are at most the 128 bytes of push constants.
#ifndef NEPHROID_RENDER_FRAME_DATA_H
#define NEPHROID_RENDER_FRAME_DATA_H

#include "techniques/scene_data.h"

#include "optics/emitter.h"

SHARED_BEGIN

struct ShadowConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  mat4 objectToMap;
};

// Material and emitter travel with the constants: software devices read memory one thread at a time.
struct SurfaceConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  mat4 worldToClip;
  uint object;
  vec3 color;  // reflectance
  uint material;
};

struct DirectConstants {
  Emitter emitter;
  vec4 mapX;  // a point's place in the map: dot(mapX, (point, 1)) and mapY, over the depth in a perspective
  vec4 mapY;
  vec4 mapDepth;     // m along the map's axis in a perspective, else the map's depth
  float depthScale;  // perspective: the map's depth is depthScale + depthOffset / dot(mapDepth, (point, 1))
  float depthOffset;
  float texelSize;          // m, width of a map's texel on a surface facing the light is
  float texelSizePerDepth;  // texelSize + texelSizePerDepth * depth; 0 unless in perspective
  uint firstMap;
};

struct CompositeConstants {
  BUFFER_ADDRESS(SceneMaterials) materials;
  vec3 ambient;     // lux
  vec3 background;  // nit
  float exposure;
};

SHARED_END

#endif
