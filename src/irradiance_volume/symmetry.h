// What turns and mirrors a caster onto itself, so that light from fewer directions need be followed (Wyman
// 2004, section 6).
#pragma once

#include "geometry/bounds.h"
#include "trace/ray_scene.h"

namespace nephroid {

// About the center of the mesh's bounding sphere, which the center of a symmetric mesh is.
struct Symmetry {
  bool isBall = false;
  uint32_t axis = 3;                        // of revolution: 0, 1, 2; 3 for none
  bool mirrors[3] = {false, false, false};  // by the plane across x, y, z
  bool operator==(const Symmetry&) const = default;
};

// Found by rays: those turned or mirrored must meet the same surface. `rays` is of the one mesh.
Symmetry findSymmetry(const RayScene& rays, const Sphere& sphere);

}  // namespace nephroid
