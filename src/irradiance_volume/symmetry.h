// What turns and mirrors a caster onto itself, so that light from fewer directions need be followed (Wyman
// 2004, section 6).
#pragma once

#include "trace/ray_scene.h"

namespace nephroid {

// A caster's bounding sphere, in its own space.
struct BoundingSphere {
  vec3 centre{0};
  float radius = 1;
};

// About the middle of the bounding box, which the centre of a symmetric mesh is.
BoundingSphere boundingSphere(const Mesh& mesh);

// About the centre of the bounding sphere.
struct Symmetry {
  bool isBall = false;
  uint32_t axis = 3;                        // of revolution: 0, 1, 2; 3 for none
  bool mirrors[3] = {false, false, false};  // by the plane across x, y, z
  bool operator==(const Symmetry&) const = default;
};

// Found by rays: those turned or mirrored must meet the same surface. `rays` is of the one mesh.
Symmetry findSymmetry(const RayScene& rays, const BoundingSphere& sphere);

}  // namespace nephroid
