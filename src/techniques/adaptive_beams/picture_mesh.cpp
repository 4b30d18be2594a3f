#include "techniques/adaptive_beams/picture_mesh.h"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"

namespace nephroid {
namespace {

// Beams for each pixel of a picture that is to be moved by hand, with an error of 1 %; more for a smaller
// one.
constexpr float kBeamsOfPixel = 1.0f / 8, kErrorOfMost = 0.01f;
constexpr uint64_t kFewestBeams = 40'000, kMostBeams = 4'000'000;
// Of a caster, what a receiver's point shows of its light at most, however far the eye is; and of the
// smallest caster the least.
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
  const float beams = kBeamsOfPixel * float(size.x) * float(size.y);
  wanted.mostBeams =
      std::clamp(uint64_t(beams * std::max(kErrorOfMost / wanted.error, 1.0f)), kFewestBeams, kMostBeams);
  wanted.eye = scene.camera.position;
  wanted.detailPerMeter =
      2 * std::tan(0.5f * glm::radians(scene.camera.verticalFov)) / float(std::max(size.y, 1u));
  wanted.mostDetailOfCaster = kMostDetail;
  wanted.detail = kLeastDetail * smallest;
  return wanted;
}

}  // namespace nephroid
