// What light, or sight, is inside of.
#pragma once

#include <array>
#include <span>

#include "trace/ray_scene.h"

namespace nephroid {

// The transparent objects around a point, by index. Where several overlap, the one that encloses the least
// volume fills the point: a bubble its glass, and a wall of glass the water that reaches into it.
struct MediumStack {
  std::array<uint32_t, 8> objects{};  // by volume, the smallest last
  std::array<float, 8> volumes{};     // m3
  uint32_t size = 0;

  // The object whose material is here; kNone for air.
  uint32_t top() const { return size ? objects[size - 1] : kNone; }
  bool contains(uint32_t object) const;
  // `volume` (m3) as RayScene::enclosedVolume.
  void enter(uint32_t object, float volume);
  void leave(uint32_t object);
};

// The closed transparent objects around a point. `materials`: of each object.
MediumStack mediaAround(const RayScene& rays, std::span<const Material* const> materials, vec3 point);

// The material of every object of a scene, which must outlive them.
std::vector<const Material*> materialsOf(const Scene& scene);

}  // namespace nephroid
