#include "trace/media.h"

#include <algorithm>

namespace nephroid {
namespace {

constexpr uint32_t kMaximumBoundaries = 192;  // looked at along a ray

}  // namespace

bool MediumStack::contains(uint32_t object) const {
  return std::find(objects.begin(), objects.begin() + size, object) != objects.begin() + size;
}

void MediumStack::enter(uint32_t object, float volume) {
  if (size == objects.size()) return;
  uint32_t place = size++;
  for (; place > 0 && volumes[place - 1] < volume; --place) {
    objects[place] = objects[place - 1];
    volumes[place] = volumes[place - 1];
  }
  objects[place] = object;
  volumes[place] = volume;
}

void MediumStack::leave(uint32_t object) {
  uint32_t place = size;
  while (place > 0 && objects[place - 1] != object) --place;
  if (place == 0) return;
  std::copy(objects.begin() + place, objects.begin() + size, objects.begin() + place - 1);
  std::copy(volumes.begin() + place, volumes.begin() + size, volumes.begin() + place - 1);
  --size;
}

MediaSides sidesOf(const RayScene& rays, const MediumStack& media, uint32_t object, bool entering,
                   std::span<const Touching> touching) {
  MediaSides sides{media, media};
  const auto leave = [&](uint32_t left) {
    if (!sides.before.contains(left)) {
      sides.before.enter(left, rays.enclosedVolume(left));
    } else {
      sides.beyond.leave(left);
    }
  };
  const auto cross = [&](uint32_t crossed, bool isEntered) {
    if (isEntered) {
      sides.beyond.enter(crossed, rays.enclosedVolume(crossed));
    } else {
      leave(crossed);
    }
  };
  cross(object, entering);
  for (const Touching& other : touching) cross(other.object, entering != other.isTurned);
  return sides;
}

MediaSides sidesOf(const RayScene& rays, const MediumStack& media, const Hit& hit, vec3 direction) {
  return sidesOf(rays, media, hit.object, dot(direction, hit.geometricNormal) < 0, hit.touched());
}

MediumStack mediaAround(const RayScene& rays, std::span<const Material* const> materials, vec3 point) {
  const vec3 direction =
      glm::normalize(vec3(0.3817f, 0.8531f, 0.3551f));  // along no axis or edge likely to be met
  std::vector<int> windings(materials.size(), 0);
  Ray ray{point, direction, 0};
  Hit hit;
  for (uint32_t boundary = 0; boundary < kMaximumBoundaries && rays.intersect(ray, hit); ++boundary) {
    const int winding = dot(direction, hit.geometricNormal) > 0 ? 1 : -1;
    windings[hit.object] += winding;
    for (const Touching& other : hit.touched()) windings[other.object] += other.isTurned ? -winding : winding;
    ray.nearDistance = hit.distance + rays.clearance(hit.object, hit.geometricNormal, direction);
  }
  MediumStack media;
  for (uint32_t object = 0; object < windings.size(); ++object)
    if (windings[object] > 0 && materials[object]->type == MaterialType::dielectric &&
        !materials[object]->thinWalled)
      media.enter(object, rays.enclosedVolume(object));
  return media;
}

std::vector<const Material*> materialsOf(const Scene& scene) {
  std::vector<const Material*> materials;
  for (const Object& object : scene.objects) materials.push_back(&scene.materialOf(object));
  return materials;
}

}  // namespace nephroid
