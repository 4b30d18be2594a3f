#include "report/seen_directly.h"

#include <oneapi/tbb/parallel_for.h>

#include <array>

#include "reference/pinhole.h"

namespace nephroid {

std::vector<uint8_t> seesReceiver(const Scene& scene, const RayScene& rays, uvec2 size) {
  const Pinhole picture(scene.camera, size);
  const auto seesCaster = [&](vec2 place) {
    Hit hit;
    return rays.intersect(picture.rayThrough(place), hit) && scene.isCaster(scene.objects[hit.object]);
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
