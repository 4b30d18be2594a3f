#include "reference/photon_map.h"

#include <algorithm>
#include <bit>

namespace nephroid {

PhotonMap::PhotonMap(std::vector<StoredPhoton> photons, float cell) : inverseCell_(1 / cell) {
  if (photons.empty()) return;
  for (const StoredPhoton& photon : photons) bounds_.include(photon.position);
  // Cells are numbered by integers, and there is nothing to gain from more of them than photons along an
  // axis.
  const vec3 farthest = glm::max(glm::abs(bounds_.low), glm::abs(bounds_.high));
  const float most = bounds_.longestSide();
  inverseCell_ = std::min({inverseCell_, 4096.0f / std::max(most, 1e-20f),
                           1e9f / std::max({farthest.x, farthest.y, farthest.z, 1e-20f})});

  firstOfBucket_.assign(std::bit_ceil(photons.size() + 1) + 1, 0);
  std::vector<uint32_t> buckets(photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i)
    ++firstOfBucket_[(buckets[i] = bucketOf(cellOf(photons[i].position))) + 1];
  for (std::size_t bucket = 1; bucket < firstOfBucket_.size(); ++bucket)
    firstOfBucket_[bucket] += firstOfBucket_[bucket - 1];
  std::vector<uint32_t> next(firstOfBucket_.begin(), firstOfBucket_.end() - 1);
  sorted_.resize(photons.size());
  for (std::size_t i = 0; i < photons.size(); ++i) sorted_[next[buckets[i]]++] = photons[i];
}

vec2 PhotonMap::reach(vec3 origin, vec3 direction, float length, float radius) const {
  if (sorted_.empty()) return vec2(0);
  return wayThroughBox(bounds_.low - radius, bounds_.high + radius, origin, direction, length);
}

// Teschner et al. 2003.
uint32_t PhotonMap::bucketOf(Cell cell) const {
  const uint32_t mixed =
      uint32_t(cell.x) * 73856093u ^ uint32_t(cell.y) * 19349663u ^ uint32_t(cell.z) * 83492791u;
  return (mixed ^ mixed >> 15) & uint32_t(firstOfBucket_.size() - 2);
}

}  // namespace nephroid
