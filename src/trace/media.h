// The transparent objects around a point of a path.
#pragma once

#include <array>
#include <span>

#include "trace/ray_scene.h"

namespace nephroid {

// The transparent objects around a point, by index. Where several overlap, the medium at the point is that of
// the object with the smallest volume: a bubble within glass is air, and glass that stands in water is glass.
struct MediumStack {
  std::array<uint32_t, 8> objects{};  // by volume, the smallest last
  std::array<float, 8> volumes{};     // m3
  uint32_t size = 0;

  // The object whose material is here; kNone for air.
  uint32_t top() const { return size ? objects[size - 1] : kNone; }
  bool contains(uint32_t object) const;
  // `volume`: m3, RayScene::enclosedVolume of the object.
  void enter(uint32_t object, float volume);
  void leave(uint32_t object);
};

// The media on both sides of a boundary.
struct MediaSides {
  MediumStack before, beyond;
};

// Where a path inside `media` meets a dielectric surface, and those that lie in the same place, along
// `direction`. What is left that was never entered, through an open mesh, was around the path all the same.
MediaSides sidesOf(const RayScene& rays, const MediumStack& media, uint32_t object, bool entering,
                   std::span<const Touching> touching);
MediaSides sidesOf(const RayScene& rays, const MediumStack& media, const Hit& hit, vec3 direction);

// Finds the closed transparent objects around a point. `materials`: one for each object.
MediumStack mediaAround(const RayScene& rays, std::span<const Material* const> materials, vec3 point);

// The material of each object. The scene must outlive the result.
std::vector<const Material*> materialsOf(const Scene& scene);

}  // namespace nephroid
