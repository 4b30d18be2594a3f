// Where surfaces of different objects lie in the same place: liquid along the wall of its glass, panes that
// are glued together, an object that stands on another. Light meets them as one boundary.
#pragma once

#include <span>
#include <vector>

#include "geometry/box.h"
#include "scene/scene.h"

namespace nephroid {

struct Contacts {
  // [object][triangle], an index in `sets`; 0 where no other object's surface lies. Empty for objects that
  // touch none.
  std::vector<std::vector<uint32_t>> setOf;
  std::vector<std::vector<uint32_t>> sets;  // of objects, ascending; the first is empty

  bool areNone() const { return sets.size() < 2; }
  // The other objects whose surfaces lie where some of this triangle is.
  std::span<const uint32_t> around(uint32_t object, uint32_t triangle) const {
    if (areNone() || setOf[object].empty()) return {};
    return sets[setOf[object][triangle]];
  }
};

// m, across their surfaces, that two objects may be apart that touch. `rounding`: m, of either
// (RayScene::rounding). It grows with their coordinates, and lets files with six digits touch.
inline float touchingDistance(float roundingOfOne, float roundingOfOther) {
  return 8 * (roundingOfOne + roundingOfOther);
}

// Only what has an inside, glass or water, joins with what it touches; a diffuse surface on a mirror does
// not. Waves touch nothing. `boxes`: of the meshes. `roundings`: m, of the objects.
Contacts findContacts(const Scene& scene, std::span<const Box> boxes, std::span<const float> roundings);

}  // namespace nephroid
