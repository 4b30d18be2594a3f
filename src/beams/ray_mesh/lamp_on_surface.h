// A lamp that lies on the surface of a caster.
#pragma once

#include "trace/ray_scene.h"

namespace nephroid {

// Where light of a point (m) is taken to begin that lies on a caster's surface, or between its triangles and
// the curved surface that they stand for: a hair outside. Other points stay where they are.
vec3 besideSurfaces(const Scene& scene, const RayScene& rays, vec3 point);

}  // namespace nephroid
