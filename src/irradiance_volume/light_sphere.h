// Evenly spread directions: the vertices of an icosahedron whose triangles are cut into four several times
// (Wyman 2004, section 4.1).
#pragma once

#include <array>
#include <span>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

inline constexpr uint32_t kMostLightLevels = 6;

// Three directions around one, with weights that add up to 1.
struct DirectionTriangle {
  std::array<uint32_t, 3> vertex{};
  std::array<float, 3> weight{};
};

class LightSphere {
 public:
  // Cuts triangles `level` times; this gives 10 * 4^level + 2 directions.
  explicit LightSphere(uint32_t level);

  const std::vector<vec3>& directions() const { return directions_; }  // unit
  // The finest triangles between the directions, counterclockwise from outside.
  std::span<const uvec3> triangles() const {
    return std::span(triangles_).last(std::size_t{20} << (2 * level_));
  }
  // The triangle around a unit vector, with the vector's barycentric coordinates.
  DirectionTriangle around(vec3 direction) const;

 private:
  uint32_t level_;
  std::vector<vec3> directions_;
  std::vector<uvec3>
      triangles_;  // level after level; triangle t of one is cut into 4 t .. 4 t + 3 of the next
};

}  // namespace nephroid
