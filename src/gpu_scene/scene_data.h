// The scene for shaders: arrays behind buffer references, with the same indices as in Scene.
#ifndef NEPHROID_GPU_SCENE_SCENE_DATA_H
#define NEPHROID_GPU_SCENE_SCENE_DATA_H

#include "gpu/buffer_address.h"

#include "core/shared_language.h"

SHARED_BEGIN

SHARED_CONSTANT uint kMaterialDiffuse = 0u;
SHARED_CONSTANT uint kMaterialDielectric = 1u;
SHARED_CONSTANT uint kMaterialMirror = 2u;

struct SceneVertex {
  vec3 position;  // m, in the object's own space
  vec3 normal;    // unit
  vec2 texcoord;
};

struct SceneObject {
  vec4 toWorld[3];  // rows of the affine map from the object's own space
  uint material;
};

struct SceneMaterial {
  vec3 color;
  uint type;      // kMaterial...
  vec3 emission;  // nit
  float ior;      // of the middle channel
  vec3 attenuationColor;
  float inverseAttenuationDistance;  // 1/m, 0 for a clear material
};

SHARED_FUNCTION vec3 worldPoint(SceneObject object, vec3 p) {
  return vec3(dot(object.toWorld[0], vec4(p, 1.0f)), dot(object.toWorld[1], vec4(p, 1.0f)),
              dot(object.toWorld[2], vec4(p, 1.0f)));
}

// Rotates a vector to world space; its length is multiplied by the object's scale.
SHARED_FUNCTION vec3 worldVector(SceneObject object, vec3 v) {
  return vec3(dot(object.toWorld[0], vec4(v, 0.0f)), dot(object.toWorld[1], vec4(v, 0.0f)),
              dot(object.toWorld[2], vec4(v, 0.0f)));
}

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::SceneVertex) == 32 && sizeof(nephroid::SceneObject) == 52 &&
              sizeof(nephroid::SceneMaterial) == 48);
#else
layout(buffer_reference, scalar) readonly buffer SceneVertices {
  SceneVertex vertex[];
};
layout(buffer_reference, scalar) readonly buffer SceneObjects {
  SceneObject object[];
};
layout(buffer_reference, scalar) readonly buffer SceneMaterials {
  SceneMaterial material[];
};
#endif

#endif
