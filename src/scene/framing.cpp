#include "scene/framing.h"

#include "geometry/mesh_checks.h"

namespace nephroid {

std::pair<vec3, vec3> placedBounds(const Mesh& mesh, const Placement& placement) {
  const auto [lower, upper] = boundingBox(mesh);
  vec3 low(std::numeric_limits<float>::infinity()), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    const vec3 p = placement.point(
        {corner & 1 ? upper.x : lower.x, corner & 2 ? upper.y : lower.y, corner & 4 ? upper.z : lower.z});
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  return {low, high};
}

std::pair<vec3, vec3> worldBounds(const Scene& scene, const Object& object) {
  return placedBounds(scene.meshOf(object), object.placement);
}

vec3 upFor(vec3 view) {
  const vec3 along = glm::normalize(view);
  return std::abs(along.y) > 0.999f ? vec3(0, 0, -1) : vec3(0, 1, 0);
}

Camera framingCamera(const Scene& scene) {
  Camera camera;
  vec3 low(std::numeric_limits<float>::infinity()), high = -low;
  bool hasCaster = false;
  for (const Object& object : scene.objects) hasCaster = hasCaster || scene.isCaster(object);
  for (const Object& object : scene.objects) {
    if (hasCaster && !scene.isCaster(object)) continue;
    const auto [objectLow, objectHigh] = worldBounds(scene, object);
    low = glm::min(low, objectLow);
    high = glm::max(high, objectHigh);
  }
  if (scene.objects.empty()) return camera;
  const float radius = std::max(0.5f * glm::distance(low, high), 1e-4f);
  const float distance = 1.5f * radius / std::sin(glm::radians(camera.verticalFov / 2));
  camera.target = 0.5f * (low + high);
  camera.position = camera.target + distance * glm::normalize(vec3(0, 0.5f, 1));
  return camera;
}

}  // namespace nephroid
