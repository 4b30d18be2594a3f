// Refines triangles of a caster's mesh: cuts them into four where the rays of the corners do not represent
// the rays between them. Used for beams and for view rays.
#pragma once

#include <algorithm>
#include <array>

#include "geometry/curved_triangle.h"
#include "transport/source.h"

namespace nephroid {

// A triangle of a caster's mesh. World space.
struct CasterTriangle {
  mat3 positions{1};  // m, one column for each corner
  mat3 normals{1};
  vec3 geometricNormal{0};  // unit
  bool isCurved = false;

  // Both matrices have one column for each corner.
  CasterTriangle(const mat3& cornersOf, const mat3& normalsOf, bool curved)
      : positions(cornersOf), normals(normalsOf), isCurved(curved) {
    const vec3 doubledArea = cross(positions[1] - positions[0], positions[2] - positions[0]);
    geometricNormal = doubledArea / std::max(length(doubledArea), 1e-30f);
  }

  // `weights`: barycentric.
  SurfacePoint at(vec3 weights) const {
    SurfacePoint point;
    point.position = point.flatPosition = positions * weights;
    if (isCurved) point.position += curvedOffset(point.flatPosition, weights, positions, normals);
    point.normal = normalize(normals * weights);
    point.geometricNormal = geometricNormal;
    return point;
  }
};

// The barycentric weights of the middle of a part of a triangle.
template <class Corner>
vec3 middleWeights(const std::array<Corner, 3>& t) {
  return (t[0].weights + t[1].weights + t[2].weights) / 3.0f;
}

// The decision about a triangle before the rays at the middles of its sides are known.
enum class Refining {
  done,        // nothing more to do
  cut,         // into four
  askMiddles,  // trace the rays at the middles of the sides, and cut into four unless they are as expected
};

// Refines a triangle. Corner::weights are barycentric weights in the mesh's triangle. `rules` has
//   Refining judge(const Triangle&, uint32_t cuts, Result&) const, which may add it to the result
//   Corner middle(const Triangle&, std::size_t side) const, between corners `side` and `side` + 1
//   bool isStraight(const Triangle&, const Triangle& middles) const
//   void keep(const Triangle&, Result&) const
//   void countCut(Result&) const
// `cuts`: how many times the triangle may be cut. Before that it is cut `forcedCuts` times without a
// decision.
template <class Rules, class Corner, class Result>
void refineTriangle(const Rules& rules, const std::array<Corner, 3>& t, uint32_t cuts, uint32_t forcedCuts,
                    Result& result) {
  using Triangle = std::array<Corner, 3>;
  const Refining step = forcedCuts > 0 ? Refining::cut : rules.judge(t, cuts, result);
  if (step == Refining::done) return;
  const Triangle m{rules.middle(t, 0), rules.middle(t, 1), rules.middle(t, 2)};
  if (step == Refining::askMiddles && rules.isStraight(t, m)) return rules.keep(t, result);
  rules.countCut(result);
  for (const Triangle& part : {Triangle{t[0], m[0], m[2]}, Triangle{m[0], t[1], m[1]},
                               Triangle{m[2], m[1], t[2]}, Triangle{m[0], m[1], m[2]}})
    refineTriangle(rules, part, forcedCuts > 0 ? cuts : cuts - 1, forcedCuts > 0 ? forcedCuts - 1 : 0,
                   result);
}

}  // namespace nephroid
