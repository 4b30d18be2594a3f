// How much room objects take, and where a camera stands when the scene does not say.
#pragma once

#include "geometry/box.h"
#include "scene/scene.h"

namespace nephroid {

// Around an object, where it stands.
Box worldBounds(const Scene& scene, const Object& object);

// Around all casters, or all objects where there are none: what cameras and lights are there for. Empty
// without objects.
Box boundsOfInterest(const Scene& scene);

// Up along y, unless the view (any length) runs along it.
vec3 upFor(vec3 view);

// A camera that sees, from the front and above, all casters, or all objects where there are none. Throws
// InputError as checkObjects does.
Camera framingCamera(const Scene& scene);

}  // namespace nephroid
