// Which triangles of a mesh meet at each of its edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

// A side is 3 * triangle + k, from the triangle's corner k to the next one.
class MeshEdges {
 public:
  // `joined`: for every vertex, the one that stands for its place. Triangles that use a place twice have no
  // sides here.
  MeshEdges(const std::vector<uvec3>& triangles, const std::vector<uint32_t>& joined);

  std::size_t count() const { return first_.size() - 1; }
  // The sides along an edge, in ascending order.
  std::span<const uint32_t> sidesOf(std::size_t edge) const {
    return {sides_.data() + first_[edge], first_[edge + 1] - first_[edge]};
  }
  // Whether two sides along one edge run the same way: one of their triangles is turned.
  bool runAlike(uint32_t a, uint32_t b) const { return runsUp_[a] == runsUp_[b]; }

 private:
  std::vector<uint32_t> sides_;  // sorted by edge
  std::vector<uint32_t> first_;  // in sides_, of each edge, and the end
  std::vector<uint8_t> runsUp_;  // of each side: from the lower place to the higher
};

}  // namespace nephroid
