// The constants of the frame's passes, for C++ and GLSL. Each fits into the 128 bytes of push constants.
#ifndef NEPHROID_RENDER_FRAME_DATA_H
#define NEPHROID_RENDER_FRAME_DATA_H

#include "gpu_scene/scene_data.h"

#include "lights/emitter.h"
#include "render/air/air_data.h"

SHARED_BEGIN

struct ShadowConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  mat4 objectToMap;
};

// Material and emitter are in the push constants because software devices read memory one thread at a time.
struct SurfaceConstants {
  BUFFER_ADDRESS(SceneVertices) vertices;
  BUFFER_ADDRESS(SceneObjects) objects;
  mat4 worldToClip;
  uint object;
  vec3 color;  // reflectance
  uint material;
};

// A light, and the projection of its shadow maps: each map looks along `mapDepth`, with `aim` in its middle.
struct DirectConstants {
  BUFFER_ADDRESS(AirLights) air;  // the first; not there where there is no air
  // As in Emitter. For a row of emitters: the first one, with `direction` (m) as the step to the next.
  vec3 position;
  float coneScale;
  vec3 direction;
  float coneOffset;
  vec3 power;
  vec3 mapX;  // dot(mapX, q) and dot(mapY, q), over the depth in a perspective: the place in a map, which
              // is 1 across; q goes from the light to the point, or from `aim` for a directional light
  float depthScale;  // what a map holds: depthScale + depthOffset / depth in a perspective, else
                     // depth + depthOffset
  vec3 mapY;
  float depthOffset;
  vec3 mapDepth;    // depth: dot(mapDepth, q), m in a perspective
  float texelSize;  // m, the width of a map's texel on a surface facing the light; at a depth of 1 m in a
                    // perspective
  vec3 aim;         // m
  uint samples;     // points of a row
  vec2 goboTurn;    // of placeInGobo
};

// The forms of lamps.
SHARED_CONSTANT uint kLampAfar = 0u;  // as kEmitterDirectional, and so on
SHARED_CONSTANT uint kLampBall = 1u;
SHARED_CONSTANT uint kLampSpot = 2u;
SHARED_CONSTANT uint kLampPanel = 3u;
SHARED_CONSTANT uint kLampLine = 4u;

// A light that is not a sky.
struct LampConstants {
  BUFFER_ADDRESS(AirLights) air;  // the first; not there where there is no air
  vec3 position;                  // m; one end of a line, the first corner of a panel
  float radius;                   // m, of a ball; from afar the sine of half the angle that it is seen under
  vec3 direction;
  float coneScale;
  vec3 power;  // cd, of the whole lamp at its peak; lux of light from afar
  float coneOffset;
  vec3 u;         // m, a panel's side; from a line's end to its other
  vec3 v;         // m, a panel's other side
  vec2 goboTurn;  // of placeInGobo
};

// The surfaces for which a pixel is lit. Each has its own SeenImages.
SHARED_CONSTANT uint kSeen = 0u;       // the receiver, in all channels, or in red where a caster disperses
SHARED_CONSTANT uint kSeenGreen = 1u;  // the receiver in green, where a caster disperses
SHARED_CONSTANT uint kSeenBlue = 2u;   // the same in blue
SHARED_CONSTANT uint kSeenReflected = 3u;  // the receiver that glass reflects
SHARED_CONSTANT uint kSeenCount = 4u;

// Of the images that hold the points of sight by rays.
SHARED_CONSTANT uint kPointsInRow = 4096u;

struct CompositeConstants {
  BUFFER_ADDRESS(SceneMaterials) materials;
  vec3 ambient;     // lux
  vec3 background;  // nit
  float exposure;
  vec3 extinctionAtEye;  // 1/m, of the water that the eye is in
};

SHARED_END

#ifdef __cplusplus
static_assert(sizeof(nephroid::DirectConstants) <= 128 && sizeof(nephroid::LampConstants) <= 128);
#endif

#endif
