// A map of photons, in which they are found by place.
#pragma once

#include <cmath>
#include <cstdint>
#include <vector>

#include "geometry/box.h"

namespace nephroid {

struct StoredPhoton {
  vec3 position{0};     // m
  vec3 flux{0};         // lm on a surface, lm m in a volume; without the weight of the band
  vec3 direction{0};    // unit; on a surface the normal of the lit side, in a volume the direction of travel
  uint32_t object = 0;  // the object that it is on or in; kNone: the air
  uint32_t index = 0;   // in its pass
  uint16_t band = 0;
  bool isDispersed = false;
};

class PhotonMap {
 public:
  // `cell`: side of a cell (m), about twice the radius of later searches.
  PhotonMap(std::vector<StoredPhoton> photons, float cell);

  // The part of a ray (its begin and end, m) that is nearer than `radius` (m) to the box around all photons.
  // Empty where the end is not larger than the begin.
  vec2 reach(vec3 origin, vec3 direction, float length, float radius) const;

  // Calls visit(photon, squared distance in m^2) for each photon nearer than `radius` (m). The order depends
  // only on the photons.
  template <class Visit>
  void around(vec3 point, float radius, const Visit& visit) const;

 private:
  using Cell = glm::ivec3;
  Cell cellOf(vec3 point) const { return Cell(glm::floor(point * inverseCell_)); }
  uint32_t bucketOf(Cell cell) const;

  float inverseCell_;                    // 1/m
  Box bounds_;                           // of all photons
  std::vector<StoredPhoton> sorted_;     // by bucket
  std::vector<uint32_t> firstOfBucket_;  // and one past the last
};

template <class Visit>
void PhotonMap::around(vec3 point, float radius, const Visit& visit) const {
  if (sorted_.empty() || glm::any(glm::lessThan(point + radius, bounds_.low)) ||
      glm::any(glm::greaterThan(point - radius, bounds_.high)))
    return;
  const Cell first = cellOf(glm::max(point - radius, bounds_.low)),
             last = cellOf(glm::min(point + radius, bounds_.high));
  for (int z = first.z; z <= last.z; ++z)
    for (int y = first.y; y <= last.y; ++y)
      for (int x = first.x; x <= last.x; ++x) {
        const Cell cell(x, y, z);
        const uint32_t bucket = bucketOf(cell);
        for (uint32_t i = firstOfBucket_[bucket]; i < firstOfBucket_[bucket + 1]; ++i) {
          const vec3 offset = sorted_[i].position - point;
          const float squared = dot(offset, offset);
          // Another cell may share the bucket, and may be asked for as well.
          if (squared < radius * radius && cellOf(sorted_[i].position) == cell) visit(sorted_[i], squared);
        }
      }
}

}  // namespace nephroid
