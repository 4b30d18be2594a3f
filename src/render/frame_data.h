// What the frame's passes are told, for C++ and GLSL. Sizes are at most the 128 bytes of push constants.
#ifndef NEPHROID_RENDER_FRAME_DATA_H
#define NEPHROID_RENDER_FRAME_DATA_H

#include "techniques/scene_data.h"

#include "optics/emitter.h"

SHARED_BEGIN

// An emitter and the shadow maps that see what stands in its light: none, one, or the six faces of a cube in
// the order +x, -x, +y, -y, +z, -z.
struct ShadowedEmitter {
  Emitter emitter;
  uint firstMap;
  uint mapCount;
  float texelSize;          // m, width of a map's texel on a surface facing the light, at clip w:
  float texelSizePerDepth;  // texelSize + texelSizePerDepth * w
};

SHARED_END

#ifndef __cplusplus
layout(buffer_reference, scalar) readonly buffer ShadowedEmitters {
  ShadowedEmitter emitter[];
};
struct ShadowProjection {
  mat4 worldToMap;
};
layout(buffer_reference, scalar) readonly buffer ShadowProjections {
  ShadowProjection map[];
};
#endif

SHARED_BEGIN

struct ShadowConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  mat4 worldToMap;
  uint object;
};

struct SurfaceConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  BUFFER_ADDRESS(SceneMaterials) materials;
  mat4 worldToClip;
  vec3 eye;  // m
  uint object;
};

struct DirectConstants {
  BUFFER_ADDRESS(ShadowedEmitters) emitters;
  BUFFER_ADDRESS(ShadowProjections) maps;
  uint emitterCount;
};

struct CompositeConstants {
  BUFFER_ADDRESS(SceneMaterials) materials;
  vec3 forward;     // unit, along the view
  vec3 right;       // half the width of what is seen at distance 1
  vec3 up;          // half its height
  vec3 ambient;     // lux
  vec3 background;  // nit
};

struct ToneConstants {
  float exposure;
};

SHARED_END

#endif
