// Where a mesh's facets end: paths begin a little off there, since it is not told on which side they are.
#pragma once

#include <vector>

#include "geometry/mesh.h"

namespace nephroid {

class FacetRims {
 public:
  // None of a mesh that is smooth all over.
  explicit FacetRims(const Mesh& mesh);

  // Weights of the second and third corner of a triangle's point, moved off the rim where it is on it.
  vec2 movedOff(const Mesh& mesh, uint32_t triangle, vec2 weights) const;

 private:
  std::vector<uint8_t> isRim_;        // of the side opposite to each of a triangle's corners
  std::vector<uint8_t> isRimCorner_;  // of each vertex
};

}  // namespace nephroid
