// Where to put shadow maps so that few texels are wasted: what can shadow anything, and projections that just
// hold it.
#pragma once

#include <vector>

#include "optics/emitter.h"
#include "scene/scene.h"

namespace nephroid {

// The space a mesh takes up, in its own coordinates (m).
struct MeshExtent {
  vec3 low{0};  // box
  vec3 high{0};
  float radius = 0;     // of the sphere about the box's centre
  bool isFlat = false;  // all vertices in the plane through the box's centre across `normal`
  vec3 normal{0, 1, 0};
};

MeshExtent extentOf(const Mesh& mesh);

struct ShadowCaster {
  uint32_t object = 0;  // index
  bool hidesItsFarSide =
      false;  // closed, and the light is outside: its near side shades all that the far side would
};

struct ShadowMap {
  mat4 worldToMap{1};                 // to clip space, depth 0 at the light and 1 at the far end
  std::vector<ShadowCaster> casters;  // those that reach into it
};

// An emitter and the maps that see what stands in its light: none, one, or the six faces of a cube in the
// order +x, -x, +y, -y, +z, -z.
struct ShadowedEmitter {
  Emitter emitter{};
  uint32_t firstMap = 0;
  uint32_t mapCount = 0;
  float texelSize = 0;          // m, width of a map's texel on a surface facing the light, at clip w:
  float texelSizePerDepth = 0;  // texelSize + texelSizePerDepth * w; 0 unless in perspective
};

struct ShadowPlan {
  std::vector<ShadowedEmitter> emitters;
  std::vector<ShadowMap> maps;
};

// One map for a directional light, for a spot, and for a point light that sees all that can shadow within 60
// degrees of an axis; six for other point lights. `extents` are those of scene.meshes; `resolution` is in
// texels.
ShadowPlan planShadowMaps(const Scene& scene, const std::vector<MeshExtent>& extents, uint32_t resolution);

}  // namespace nephroid
