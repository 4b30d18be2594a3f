// Where a camera stands when the scene does not say.
#pragma once

#include <utility>

#include "scene/scene.h"

namespace nephroid {

// The corners of a box around a mesh, and around an object, where it stands.
std::pair<vec3, vec3> placedBounds(const Mesh& mesh, const Placement& placement);
std::pair<vec3, vec3> worldBounds(const Scene& scene, const Object& object);

// Up along y, unless the view (any length) runs along it.
vec3 upFor(vec3 view);

// A camera that sees, from the front and above, all casters, or all objects where there are none.
Camera framingCamera(const Scene& scene);

}  // namespace nephroid
