// Photons where they landed, found by place.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/box.h"

namespace nephroid {

struct StoredPhoton {
  vec3 position{0};   // m
  vec3 flux{0};       // lm on a surface; lm m in a volume; the band's weight not counted
  vec3 direction{0};  // unit: of a surface the normal on the lit side, in a volume the way the photon travels
  uint32_t object = 0;  // it is on or in; kNone: the air
  uint16_t band = 0;
  bool isDispersed = false;
};

class PhotonMap {
 public:
  // `cell`: m, about the diameter that is asked for.
  PhotonMap(std::vector<StoredPhoton> photons, float cell);

  // The part of a ray, from and to (m), that comes nearer than `radius` to the box around all photons; empty
  // where the second is not above the first.
  vec2 reach(vec3 origin, vec3 direction, float length, float radius) const;

  // Calls visit(photon, squared distance) for each photon nearer than `radius` (m), in an order that depends
  // on the photons alone.
  template <class Visit>
  void around(vec3 point, float radius, const Visit& visit) const;

 private:
  using Cell = glm::ivec3;
  Cell cellOf(vec3 point) const { return Cell(glm::floor(point * inverseCell)); }
  uint32_t bucketOf(Cell cell) const;

  float inverseCell;                    // 1/m
  Box bounds;                           // of all photons
  std::vector<StoredPhoton> sorted;     // by bucket
  std::vector<uint32_t> firstOfBucket;  // and one past the last
};

template <class Visit>
void PhotonMap::around(vec3 point, float radius, const Visit& visit) const {
  if (sorted.empty() || glm::any(glm::lessThan(point + radius, bounds.low)) ||
      glm::any(glm::greaterThan(point - radius, bounds.high)))
    return;
  const Cell first = cellOf(glm::max(point - radius, bounds.low)),
             last = cellOf(glm::min(point + radius, bounds.high));
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const Cell cell(x, y, z);
        const uint32_t bucket = bucketOf(cell);
        for (uint32_t i = firstOfBucket[bucket]; i < firstOfBucket[bucket + 1]; ++i) {
          const vec3 offset = sorted[i].position - point;
          const float squared = dot(offset, offset);
          // Another cell may share the bucket, and may be asked for as well.
          if (squared < radius * radius && cellOf(sorted[i].position) == cell) visit(sorted[i], squared);
        }
      }
}

}  // namespace nephroid
