#include "geometry/shapes.h"

#include <algorithm>
#include <array>

#include "geometry/mesh_checks.h"
#include "geometry/shape_grid.h"

namespace nephroid {
namespace {

constexpr uint32_t kDefaultVertices = 6400;
constexpr uint32_t kDefaultFlatSegments = 8;

template <class Count>
uint32_t segmentsOf(Density density, uint32_t atLeast, const Count& count) {
  if (density.segments > 0) return std::max(density.segments, atLeast);
  return partsForVertices(density.vertices > 0 ? density.vertices : kDefaultVertices, atLeast, count);
}

template <class Count>
uint32_t flatSegmentsOf(Density density, const Count& count) {
  if (density.segments > 0) return density.segments;
  return density.vertices > 0 ? partsForVertices(density.vertices, 1, count) : kDefaultFlatSegments;
}

Mesh finished(Mesh mesh, const char* name) {
  mesh.name = name;
  mesh.isCurved = true;
  finishMesh(mesh, name);
  return mesh;
}

constexpr std::array<uvec3, 20> kIcosahedronFaces{
    uvec3{0, 11, 5}, {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
    {11, 10, 2},     {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
    {3, 8, 9},       {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};

dvec3 icosahedronCorner(uint32_t i) {
  const double g = std::numbers::phi;
  const std::array<dvec3, 12> corners{dvec3{-1, g, 0}, {1, g, 0}, {-1, -g, 0}, {1, -g, 0},
                                      {0, -1, g},      {0, 1, g}, {0, -1, -g}, {0, 1, -g},
                                      {g, 0, -1},      {g, 0, 1}, {-g, 0, -1}, {-g, 0, 1}};
  return corners[i];
}

// Summed in the order of the corners, so that faces agree exactly about the points of the edge between them.
dvec3 icospherePoint(uvec3 face, uvec3 weights) {
  std::array<std::pair<uint32_t, uint32_t>, 3> terms{
      {{face.x, weights.x}, {face.y, weights.y}, {face.z, weights.z}}};
  std::sort(terms.begin(), terms.end());
  dvec3 sum(0);
  for (const auto& [corner, weight] : terms) {
    if (weight > 0) sum += icosahedronCorner(corner) * static_cast<double>(weight);
  }
  return glm::normalize(sum);
}

// The points of a triangle cut into n^2: row by row from its first corner, row k holding k + 1 points.
template <class Point>
void addTriangleGrid(Mesh& mesh, uint32_t n, const Point& point) {
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  for (uint32_t row = 0; row <= n; ++row) {
    for (uint32_t k = 0; k <= row; ++k) addVertex(mesh, point(uvec3(n - row, row - k, k)));
  }
  for (uint32_t row = 0; row < n; ++row) {
    const uint32_t upper = first + row * (row + 1) / 2, lower = upper + row + 1;
    for (uint32_t k = 0; k <= row; ++k) mesh.triangles.emplace_back(upper + k, lower + k, lower + k + 1);
    for (uint32_t k = 0; k < row; ++k) mesh.triangles.emplace_back(upper + k, lower + k + 1, upper + k + 1);
  }
}

// A flat disk at height y of 6 m edges round it, cut like a honeycomb; looks up or down.
void addDisk(Mesh& mesh, double radius, double y, uint32_t m, bool up) {
  const dvec3 normal{0, up ? 1 : -1, 0};
  const auto center = addVertex(mesh, {{0, y, 0}, normal});
  uint32_t inner = center;
  for (uint32_t k = 1; k <= m; ++k) {
    const auto outer = static_cast<uint32_t>(mesh.positions.size());
    for (uint32_t i = 0; i < 6 * k; ++i) {
      addVertex(mesh, {radius * between(0, 1, k, m) * aroundY(i, 6 * k) + dvec3(0, y, 0), normal});
    }
    const auto innerAt = [&](uint32_t i) { return k == 1 ? center : inner + i % (6 * (k - 1)); };
    const auto outerAt = [&](uint32_t i) { return outer + i % (6 * k); };
    const auto add = [&](uint32_t a, uint32_t b, uint32_t c) {
      mesh.triangles.emplace_back(a, up ? b : c, up ? c : b);
    };
    for (uint32_t sector = 0; sector < 6; ++sector) {
      for (uint32_t j = 0; j < k; ++j) {
        const uint32_t in = sector * (k - 1) + j, out = sector * k + j;
        add(innerAt(in), outerAt(out), outerAt(out + 1));
        if (j + 1 < k) add(innerAt(in), outerAt(out + 1), innerAt(in + 1));
      }
    }
    inner = outer;
  }
}

// The wall of a cylinder, from bottom to top; looks away from the axis or toward it.
void addWall(Mesh& mesh, double radius, double height, uint32_t around, uint32_t along, bool outward) {
  addGrid(mesh, around, along, [&](uint32_t i, uint32_t j) {
    const dvec3 axis = aroundY(i, around);
    const double y =
        outward ? between(-height / 2, height / 2, j, along) : between(height / 2, -height / 2, j, along);
    return ShapePoint{radius * axis + dvec3(0, y, 0), outward ? axis : -axis};
  });
}

}  // namespace

Mesh makeSphere(float radius, Density density) {
  constexpr uint32_t kFacesRound = 5;  // of an icosahedron, once round
  const uint32_t n = density.segments > 0 ? parts(density.segments, kFacesRound)
                                          : segmentsOf(density, 1, [](uint64_t f) { return 10 * f * f + 2; });
  Mesh mesh;
  for (const uvec3 face : kIcosahedronFaces) {
    addTriangleGrid(mesh, n, [&](uvec3 weights) {
      const dvec3 normal = icospherePoint(face, weights);
      return ShapePoint{normal * static_cast<double>(radius), normal};
    });
  }
  return finished(std::move(mesh), "sphere");
}

Mesh makeTorus(float radius, float tube, Density density) {
  const auto roundTube = [&](uint32_t n) { return parts(n * static_cast<double>(tube), radius, 6); };
  const uint32_t n = segmentsOf(density, 6, [&](uint32_t k) { return uint64_t{k} * roundTube(k); });
  const uint32_t m = roundTube(n);
  Mesh mesh;
  addGrid(mesh, n, m, [&](uint32_t i, uint32_t j) {
    const double angle = kTurn * (j % m) / m;
    const dvec3 axis = aroundY(i, n), normal = std::cos(angle) * axis + dvec3(0, std::sin(angle), 0);
    return ShapePoint{static_cast<double>(radius) * axis + static_cast<double>(tube) * normal, normal};
  });
  return finished(std::move(mesh), "torus");
}

Mesh makeTorusKnot(uint32_t p, uint32_t q, float radius, float tube, Density density) {
  const double r = radius / 2.0;
  const double length = kTurn * r * std::hypot(2.0 * p, static_cast<double>(q));  // nearly
  const auto roundTube = [&](uint32_t n) { return parts(n * kTurn * tube, length, 6); };
  const uint32_t n = segmentsOf(density, 6, [&](uint32_t k) { return uint64_t{k} * roundTube(k); });
  const uint32_t m = roundTube(n);
  Mesh mesh;
  addGrid(mesh, n, m, [&](uint32_t i, uint32_t j) {
    const double t = kTurn * (i % n) / n, a = p * t, b = q * t, angle = kTurn * (j % m) / m;
    const dvec3 radial{std::cos(a), 0, -std::sin(a)}, onward{-std::sin(a), 0, -std::cos(a)}, up{0, 1, 0};
    const dvec3 curve = r * ((2 + std::cos(b)) * radial + std::sin(b) * up);
    const dvec3 tangent = glm::normalize(static_cast<double>(q) * (std::cos(b) * up - std::sin(b) * radial) +
                                         p * (2 + std::cos(b)) * onward);
    // The normal of the torus the curve lies on is across the curve, and closes with it.
    const dvec3 across = std::cos(b) * radial + std::sin(b) * up;
    const dvec3 normal = std::cos(angle) * across + std::sin(angle) * glm::cross(across, tangent);
    return ShapePoint{curve + static_cast<double>(tube) * normal, normal};
  });
  return finished(std::move(mesh), "torus_knot");
}

Mesh makeBox(vec3 size, Density density) {
  const dvec3 half = 0.5 * dvec3(size);
  const double longest = std::max({size.x, size.y, size.z});
  const auto cells = [&](uint32_t n) {
    return uvec3(parts(size.x, longest / n), parts(size.y, longest / n), parts(size.z, longest / n));
  };
  const uint32_t n = flatSegmentsOf(density, [&](uint32_t k) {
    const glm::u64vec3 c = cells(k);
    return 2 * ((c.x + 1) * (c.y + 1) + (c.y + 1) * (c.z + 1) + (c.z + 1) * (c.x + 1));
  });
  const uvec3 c = cells(n);
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double sign : {1.0, -1.0}) {
      const int u = sign > 0 ? (axis + 1) % 3 : (axis + 2) % 3, v = 3 - axis - u;
      addGrid(mesh, c[u], c[v], [&](uint32_t i, uint32_t j) {
        ShapePoint point{dvec3(0), dvec3(0)};
        point.normal[axis] = sign;
        point.position[axis] = sign * half[axis];
        point.position[u] = between(-half[u], half[u], i, c[u]);
        point.position[v] = between(-half[v], half[v], j, c[v]);
        return point;
      });
    }
  }
  return finished(std::move(mesh), "box");
}

Mesh makePrism(float radius, float length, Density density) {
  const double side = std::sqrt(3.0) * radius, longest = std::max<double>(side, length);
  const auto cells = [&](uint32_t n) { return uvec2(parts(side, longest / n), parts(length, longest / n)); };
  const uint32_t segments = flatSegmentsOf(density, [&](uint32_t k) {
    const glm::u64vec2 c = cells(k);
    return 3 * (c.x + 1) * (c.y + 1) + (c.x + 1) * (c.x + 2);
  });
  const uint32_t n = cells(segments).x, along = cells(segments).y;
  std::array<dvec3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) {
    const double angle = kTurn * (0.25 + static_cast<double>(k) / 3);
    corners[k] = static_cast<double>(radius) * dvec3(std::cos(angle), std::sin(angle), 0);
  }
  const auto edge = [&](std::size_t a, std::size_t b, uint32_t i) {
    return dvec3(between(corners[a].x, corners[b].x, i, n), between(corners[a].y, corners[b].y, i, n), 0);
  };
  const double end = length / 2.0;
  Mesh mesh;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const dvec3 normal = glm::normalize(corners[k] + corners[next]);
    addGrid(mesh, n, along, [&](uint32_t i, uint32_t j) {
      return ShapePoint{edge(k, next, i) + dvec3(0, 0, between(-end, end, j, along)), normal};
    });
  }
  for (const double sign : {1.0, -1.0}) {
    addTriangleGrid(mesh, n, [&](uvec3 w) {
      // On the border exactly as the sides have it.
      const dvec3 share = dvec3(w) / static_cast<double>(n);
      dvec3 p = share.x * corners[0] + share.y * corners[1] + share.z * corners[2];
      if (w.z == 0) p = edge(0, 1, w.y);
      if (w.x == 0) p = edge(1, 2, w.z);
      if (w.y == 0) p = edge(2, 0, w.x);
      return ShapePoint{p + dvec3(0, 0, sign * end), {0, 0, sign}};
    });
    if (sign > 0) continue;
    const std::size_t firstOfCap = mesh.triangles.size() - std::size_t{n} * n;
    for (std::size_t t = firstOfCap; t < mesh.triangles.size(); ++t)
      std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
  }
  return finished(std::move(mesh), "prism");
}

Mesh makeCylinder(float radius, float height, Density density) {
  const auto along = [&](uint32_t m) { return parts(height * 6.0 * m, kTurn * radius); };
  const auto count = [&](uint64_t m) {
    return 6 * m * (along(static_cast<uint32_t>(m)) + 1) + 2 * (3 * m * (m + 1) + 1);
  };
  const uint32_t m = density.segments > 0 ? parts(density.segments, 6) : segmentsOf(density, 1, count);
  Mesh mesh;
  addWall(mesh, radius, height, 6 * m, along(m), true);
  addDisk(mesh, radius, height / 2.0, m, true);
  addDisk(mesh, radius, -(height / 2.0), m, false);
  return finished(std::move(mesh), "cylinder");
}

Mesh makeRing(float radius, float height, float thickness, Density density) {
  const double inner = radius, outer = static_cast<double>(radius) + thickness;
  const auto cells = [&](uint32_t n) {
    const double edge = kTurn * inner / n;
    return uvec2(parts(height, edge), parts(thickness, edge));
  };
  const uint32_t n = segmentsOf(density, 3, [&](uint32_t k) {
    const glm::u64vec2 c = cells(k);
    return 2 * uint64_t{k} * (c.x + c.y + 2);
  });
  const uint32_t along = cells(n).x, across = cells(n).y;
  Mesh mesh;
  addWall(mesh, outer, height, n, along, true);
  addWall(mesh, inner, height, n, along, false);
  for (const double sign : {1.0, -1.0}) {
    addGrid(mesh, n, across, [&](uint32_t i, uint32_t j) {
      const double r = sign > 0 ? between(outer, inner, j, across) : between(inner, outer, j, across);
      return ShapePoint{r * aroundY(i, n) + dvec3(0, sign * (height / 2.0), 0), {0, sign, 0}};
    });
  }
  return finished(std::move(mesh), "ring");
}

Mesh makePlane(vec2 size, Density density) {
  const double longest = std::max(size.x, size.y);
  const auto cells = [&](uint32_t n) {
    return uvec2(parts(size.x, longest / n), parts(size.y, longest / n));
  };
  const bool isAsked = density.segments > 0 || density.vertices > 0;
  const uvec2 c = !isAsked ? uvec2(1) : cells(flatSegmentsOf(density, [&](uint32_t k) {
    const glm::u64vec2 n = cells(k);
    return (n.x + 1) * (n.y + 1);
  }));
  Mesh mesh;
  addGrid(mesh, c.x, c.y, [&](uint32_t i, uint32_t j) {
    return ShapePoint{{between(-size.x / 2, size.x / 2, i, c.x), 0, between(size.y / 2, -size.y / 2, j, c.y)},
                      {0, 1, 0}};
  });
  return finished(std::move(mesh), "plane");
}

}  // namespace nephroid
