#include "scene/framing.h"

#include <algorithm>

#include "geometry/bounds.h"
#include "scene/checks.h"

namespace nephroid {

Box worldBounds(const Scene& scene, const Object& object) {
  return placedBox(boundingBox(scene.meshOf(object)), object.placement);
}

Box boundsOfInterest(const Scene& scene) {
  const bool hasCaster =
      std::ranges::any_of(scene.objects, [&](const Object& object) { return scene.isCaster(object); });
  Box bounds;
  for (const Object& object : scene.objects)
    if (!hasCaster || scene.isCaster(object)) bounds.include(worldBounds(scene, object));
  return bounds;
}

vec3 upFor(vec3 view) {
  const vec3 along = glm::normalize(view);
  return std::abs(along.y) > 0.999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
}

Camera framingCamera(const Scene& scene) {
  checkObjects(scene);
  Camera camera;
  const Box bounds = boundsOfInterest(scene);
  if (bounds.isEmpty()) return camera;
  const float radius = std::max(0.5f * bounds.diagonal(), 1e-4f);
  const float distance = 1.5f * radius / std::sin(glm::radians(camera.verticalFov / 2));
  camera.target = bounds.center();
  camera.position = camera.target + distance * glm::normalize(vec3(0, 0.5f, 1));
  return camera;
}

}  // namespace nephroid
