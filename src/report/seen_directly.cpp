#include "report/seen_directly.h"

#include <oneapi/tbb/parallel_for.h>

#include <array>
#include <cmath>

namespace nephroid {
namespace {

// Directions through the places of a picture.
class PictureRays {
 public:
  PictureRays(const Camera& camera, uvec2 size) : origin_(camera.position) {
    const vec3 forward = normalize(camera.target - camera.position);
    const vec3 up = std::abs(dot(forward, normalize(camera.up))) < 0.9999f ? camera.up : vec3(0, 0, -1);
    const float height = 2 * std::tan(0.5f * glm::radians(camera.verticalFov)) / float(size.y);
    right_ = height * normalize(cross(forward, up));
    down_ = height * normalize(cross(forward, right_));
    corner_ = forward - 0.5f * (float(size.x) * right_ + float(size.y) * down_);
  }

  Ray through(vec2 place) const {
    return {origin_, normalize(corner_ + place.x * right_ + place.y * down_), 0};
  }

 private:
  vec3 origin_, corner_, right_, down_;
};

}  // namespace

std::vector<uint8_t> seesReceiver(const Scene& scene, const RayScene& rays, uvec2 size) {
  const PictureRays picture(scene.camera, size);
  const auto seesCaster = [&](vec2 place) {
    Hit hit;
    return rays.intersect(picture.through(place), hit) && scene.isCaster(scene.objects[hit.object]);
  };
  constexpr std::array<vec2, 5> kPlaces{{{0.5f, 0.5f}, {0, 0}, {1, 0}, {0, 1}, {1, 1}}};
  std::vector<uint8_t> sees(std::size_t{size.x} * size.y, 1);
  oneapi::tbb::parallel_for(0u, size.y, [&](uint32_t y) {
    for (uint32_t x = 0; x < size.x; ++x)
      for (const vec2 place : kPlaces)
        if (seesCaster(vec2(float(x), float(y)) + place)) sees[std::size_t{y} * size.x + x] = 0;
  });
  return sees;
}

}  // namespace nephroid
