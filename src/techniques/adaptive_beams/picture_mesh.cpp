#include "techniques/adaptive_beams/picture_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"

namespace nephroid {
namespace {

constexpr uint64_t kMostBeams = 150'000;  // of a picture that is to be moved by hand
// Of the smallest caster, what a receiver's point shows at most, however far the eye is.
constexpr float kMostDetail = 1.0f / 100;
constexpr float kLeastDetail = 1.0f / 20000;

float smallestCaster(const Scene& scene) {
  float least = std::numeric_limits<float>::infinity();
  for (const Object& object : scene.objects) {
    if (!scene.isCaster(object)) continue;
    least = std::min(least, object.placement.scale * boundingBox(scene.meshOf(object)).diagonal());
  }
  return least;
}

}  // namespace

RayMeshSettings settingsOfPicture(const Scene& scene, uvec2 size, const TechniqueSettings& settings) {
  const Accuracy& accuracy = accuracyOf(settings);
  const float smallest = smallestCaster(scene);
  RayMeshSettings wanted;
  wanted.error = accuracy.error;
  wanted.mostBytes = bytesForPaths(accuracy);
  wanted.paths = settings.transport.paths;
  wanted.mostBeams = kMostBeams;
  wanted.eye = scene.camera.position;
  wanted.detailPerMeter =
      2 * std::tan(0.5f * glm::radians(scene.camera.verticalFov)) / float(std::max(size.y, 1u));
  wanted.mostDetail = kMostDetail * smallest;
  wanted.detail = kLeastDetail * smallest;
  return wanted;
}

}  // namespace nephroid
