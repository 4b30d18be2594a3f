// Chooses the projections of shadow maps, so that they just hold everything that can cast a shadow.
#pragma once

#include <vector>

#include "geometry/box.h"
#include "lights/emitters.h"

namespace nephroid {

// The extent of a mesh, in its own space (m).
struct MeshExtent {
  Box box;
  float radius = 0;     // m, of the sphere around the middle of the box
  bool isFlat = false;  // all vertices in the plane through the middle of the box across `normal`
  vec3 normal{0, 1, 0};
};

MeshExtent extentOf(const Mesh& mesh);

struct ShadowCaster {
  uint32_t object = 0;           // index
  bool hidesItsFarSide = false;  // closed with the light outside, so the near side casts the whole shadow
};

struct ShadowMap {
  mat4 worldToMap{1};                 // to clip space, depth 0 at the light and 1 at the far end
  std::vector<ShadowCaster> casters;  // objects that reach into the map
};

// The projection of a light's maps: all look along `forward`, or they are the six faces of a cube in the
// order +x, -x, +y, -y, +z, -z.
struct ShadowProjection {
  vec3 right{1, 0, 0};  // unit axes of a map
  vec3 up{0, 1, 0};
  vec3 forward{0, 0, -1};
  vec3 aim{0};          // m, what the middle of each map sees
  float halfWidth = 1;  // half of the width that a map sees: m for a directional light, else m per m of depth
  float nearest = 0;    // m from the light, in a perspective, or from `aim`: where a map's depth is 0
  float farthest = 1;   // and where it is 1
};

// A row of emitters and their maps: 0, 1 or 6 for each emitter.
struct ShadowedLight {
  EmitterRow row;
  uint32_t mapCount = 0;    // for each point
  uint32_t resolution = 1;  // texels along a side of a map
  ShadowProjection projection;
  std::vector<ShadowMap> maps;  // the maps of the first emitter, then those of the next
};

// Plans the maps of all lights, one element for each row of each light. A directional light and a spot have
// one map; so has a point from which all objects that cast shadows lie within 60 degrees of an axis. Other
// points have six. `extents`: of scene.meshes. `resolution`: texels along a side, for a light with one
// emitter. The emitters of a line, an area or a sky divide this number of texels among them, because each has
// only a part of the light.
std::vector<ShadowedLight> planShadowMaps(const Scene& scene, const std::vector<MeshExtent>& extents,
                                          uint32_t resolution);

// The boxes (m, world space) of the objects that may stand between a light and another object, or between
// the light and another part of the same object. Not for a sky.
std::vector<Box> boxesThatShadow(const Scene& scene, const std::vector<MeshExtent>& extents,
                                 const Light& light);

}  // namespace nephroid
