// Where to put shadow maps so that few texels are wasted: what can shadow anything, and projections that just
// hold it.
#pragma once

#include <vector>

#include "render/frame_data.h"
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

struct ShadowMap {
  mat4 worldToMap{1};             // to clip space, depth 0 at the light and 1 at the far end
  std::vector<uint32_t> objects;  // indices of those that reach into it
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
