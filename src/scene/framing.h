// Boxes around objects, and the camera of a scene without one.
#pragma once

#include "geometry/box.h"
#include "scene/scene.h"

namespace nephroid {

// The box (m, world space) around an object.
Box worldBounds(const Scene& scene, const Object& object);

// The box (m) around all casters, or around all objects where there are no casters. Empty without objects.
Box boundsOfInterest(const Scene& scene);

// An upward direction: y, unless the view (of any length) is parallel to it.
vec3 upFor(vec3 view);

// A camera that sees boundsOfInterest from the front and above. Throws InputError as checkObjects does.
Camera framingCamera(const Scene& scene);

}  // namespace nephroid
