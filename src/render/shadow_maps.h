// Where to put shadow maps so that few texels are wasted: what can shadow anything, and projections that just
// hold it.
#pragma once

#include <vector>

#include "geometry/box.h"
#include "lights/emitters.h"

namespace nephroid {

// The space a mesh takes up, in its own coordinates (m).
struct MeshExtent {
  Box box;
  float radius = 0;     // of the sphere about the middle of the box
  bool isFlat = false;  // all vertices in the plane through the middle of the box across `normal`
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

// How the maps of a light look: all along `forward`, or the six faces of a cube in the order +x, -x, +y, -y,
// +z, -z.
struct ShadowProjection {
  vec3 right{1, 0, 0};  // unit axes of a map
  vec3 up{0, 1, 0};
  vec3 forward{0, 0, -1};
  vec3 aim{0};  // m, what the middle of each map sees
  float halfWidth =
      1;              // of what a map sees across, over the depth in a perspective; m for a directional light
  float nearest = 0;  // m from the light, in a perspective, or from `aim`: where a map's depth is 0
  float farthest = 1;  // and where it is 1
};

// A row of emitters and the maps that see what stands in their way: for each none, one, or six.
struct ShadowedLight {
  EmitterRow row;
  uint32_t mapCount = 0;    // for each point
  uint32_t resolution = 1;  // texels along a side of a map
  ShadowProjection projection;
  std::vector<ShadowMap> maps;  // those of one point after those of another
};

// One map for a directional light, for a spot, and for a point that sees all that can shadow within 60
// degrees of an axis; six for other points. `extents` are those of scene.meshes. `resolution` is that of a
// light of one point, in texels along a side; the points of a line, an area or a sky, each of which has its
// share of the light alone, have as many texels together. One after another for each row of each light.
std::vector<ShadowedLight> planShadowMaps(const Scene& scene, const std::vector<MeshExtent>& extents,
                                          uint32_t resolution);

}  // namespace nephroid
