// The rotations and reflections that map a caster onto itself. They reduce the number of light directions
// that have to be traced (Wyman 2004, section 6).
#pragma once

#include "geometry/bounds.h"
#include "trace/ray_scene.h"

namespace nephroid {

// Symmetry about the center of the mesh's bounding sphere, which is the center of a symmetric mesh.
struct Symmetry {
  bool isBall = false;
  uint32_t axis = 3;                        // of revolution: 0, 1, 2; 3 for none
  bool mirrors[3] = {false, false, false};  // by the plane across x, y, z
  bool operator==(const Symmetry&) const = default;
};

// Finds the symmetry with rays: rotated or mirrored rays must meet the same surface. `rays`: of the single
// mesh.
Symmetry findSymmetry(const RayScene& rays, const Sphere& sphere);

}  // namespace nephroid
