// The parts from which the shapes are built.
#pragma once

#include <cmath>
#include <cstdlib>

#include "core/turn.h"
#include "geometry/shapes.h"

namespace nephroid {

using glm::dvec3;

struct ShapePoint {
  dvec3 position;
  dvec3 normal;
};

inline uint32_t addVertex(Mesh& mesh, const ShapePoint& point) {
  mesh.positions.emplace_back(point.position);
  mesh.normals.emplace_back(point.normal);
  return static_cast<uint32_t>(mesh.positions.size() - 1);
}

// Adds a patch of nu x nv cells. point(i, j) returns the corner i of 0..nu and j of 0..nv; the outside is the
// side of d/di x d/dj. Where the edges of patches meet, their positions must be exactly equal; equal vertices
// are merged when the mesh is finished.
template <class Point>
void addGrid(Mesh& mesh, uint32_t nu, uint32_t nv, const Point& point) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (uint32_t j = 0; j <= nv; ++j) {
    for (uint32_t i = 0; i <= nu; ++i) addVertex(mesh, point(i, j));
  }
  for (uint32_t j = 0; j < nv; ++j) {
    for (uint32_t i = 0; i < nu; ++i) {
      const uint32_t a = first + j * (nu + 1) + i, b = a + 1, d = a + nu + 1, c = d + 1;
      const auto& p = mesh.positions;
      // Cut along the shorter diagonal; the margin keeps rounding from making a pattern of its own.
      if (glm::distance(p[b], p[d]) < 0.999f * glm::distance(p[a], p[c])) {
        mesh.triangles.emplace_back(a, b, d);
        mesh.triangles.emplace_back(b, c, d);
      } else {
        mesh.triangles.emplace_back(a, b, c);
        mesh.triangles.emplace_back(a, c, d);
      }
    }
  }
}

// Linear from exactly `from` at i = 0 to exactly `to` at i = n.
inline double between(double from, double to, uint32_t i, uint32_t n) {
  const double t = static_cast<double>(i) / n;
  return from * (1 - t) + to * t;
}

// The unit vector i of n around +y, counterclockwise from +x. i = n gives exactly the same as i = 0.
inline dvec3 aroundY(uint32_t i, uint32_t n) {
  const double angle = kTurn * (i % n) / n;
  return {std::cos(angle), 0, -std::sin(angle)};
}

// The number of parts of about the length `edge` in `length`.
inline uint32_t parts(double length, double edge, uint32_t atLeast = 1) {
  return std::max(atLeast, static_cast<uint32_t>(std::lround(length / edge)));
}

// The n for which count(n), which rises with n, is closest to `vertices`.
template <class Count>
uint32_t partsForVertices(uint32_t vertices, uint32_t atLeast, const Count& count) {
  uint32_t low = atLeast, high = atLeast + 1;
  while (count(high) < vertices) high *= 2;
  while (high - low > 1) {
    const uint32_t middle = low + (high - low) / 2;
    (count(middle) < vertices ? low : high) = middle;
  }
  const auto error = [&](uint32_t n) { return std::abs(static_cast<int64_t>(count(n)) - int64_t{vertices}); };
  return error(low) <= error(high) ? low : high;
}

}  // namespace nephroid
