#include <algorithm>
#include <array>
#include <utility>

#include "geometry/bounds.h"
#include "geometry/mesh_checks.h"
#include "geometry/shape_grid.h"

// Martin Newell's teapot (1975): ten of its bicubic patches, the others by symmetry. Z is up in the data.
namespace nephroid {
namespace {

constexpr uint32_t kDefaultSegments = 12;  // along the edge of a patch
constexpr uint32_t kFewestSegments = 2;    // with one, a tube would be flat

constexpr std::array<std::array<double, 3>, 127> kControlPoints{{
    {0.2, 0, 2.7},
    {0.2, -0.112, 2.7},
    {0.112, -0.2, 2.7},
    {0, -0.2, 2.7},
    {1.3375, 0, 2.53125},
    {1.3375, -0.749, 2.53125},
    {0.749, -1.3375, 2.53125},
    {0, -1.3375, 2.53125},
    {1.4375, 0, 2.53125},
    {1.4375, -0.805, 2.53125},
    {0.805, -1.4375, 2.53125},
    {0, -1.4375, 2.53125},
    {1.5, 0, 2.4},
    {1.5, -0.84, 2.4},
    {0.84, -1.5, 2.4},
    {0, -1.5, 2.4},
    {1.75, 0, 1.875},
    {1.75, -0.98, 1.875},
    {0.98, -1.75, 1.875},
    {0, -1.75, 1.875},
    {2, 0, 1.35},
    {2, -1.12, 1.35},
    {1.12, -2, 1.35},
    {0, -2, 1.35},
    {2, 0, 0.9},
    {2, -1.12, 0.9},
    {1.12, -2, 0.9},
    {0, -2, 0.9},
    {-2, 0, 0.9},
    {2, 0, 0.45},
    {2, -1.12, 0.45},
    {1.12, -2, 0.45},
    {0, -2, 0.45},
    {1.5, 0, 0.225},
    {1.5, -0.84, 0.225},
    {0.84, -1.5, 0.225},
    {0, -1.5, 0.225},
    {1.5, 0, 0.15},
    {1.5, -0.84, 0.15},
    {0.84, -1.5, 0.15},
    {0, -1.5, 0.15},
    {-1.6, 0, 2.025},
    {-1.6, -0.3, 2.025},
    {-1.5, -0.3, 2.25},
    {-1.5, 0, 2.25},
    {-2.3, 0, 2.025},
    {-2.3, -0.3, 2.025},
    {-2.5, -0.3, 2.25},
    {-2.5, 0, 2.25},
    {-2.7, 0, 2.025},
    {-2.7, -0.3, 2.025},
    {-3, -0.3, 2.25},
    {-3, 0, 2.25},
    {-2.7, 0, 1.8},
    {-2.7, -0.3, 1.8},
    {-3, -0.3, 1.8},
    {-3, 0, 1.8},
    {-2.7, 0, 1.575},
    {-2.7, -0.3, 1.575},
    {-3, -0.3, 1.35},
    {-3, 0, 1.35},
    {-2.5, 0, 1.125},
    {-2.5, -0.3, 1.125},
    {-2.65, -0.3, 0.9375},
    {-2.65, 0, 0.9375},
    {-2, -0.3, 0.9},
    {-1.9, -0.3, 0.6},
    {-1.9, 0, 0.6},
    {1.7, 0, 1.425},
    {1.7, -0.66, 1.425},
    {1.7, -0.66, 0.6},
    {1.7, 0, 0.6},
    {2.6, 0, 1.425},
    {2.6, -0.66, 1.425},
    {3.1, -0.66, 0.825},
    {3.1, 0, 0.825},
    {2.3, 0, 2.1},
    {2.3, -0.25, 2.1},
    {2.4, -0.25, 2.025},
    {2.4, 0, 2.025},
    {2.7, 0, 2.4},
    {2.7, -0.25, 2.4},
    {3.3, -0.25, 2.4},
    {3.3, 0, 2.4},
    {2.8, 0, 2.475},
    {2.8, -0.25, 2.475},
    {3.525, -0.25, 2.49375},
    {3.525, 0, 2.49375},
    {2.9, 0, 2.475},
    {2.9, -0.15, 2.475},
    {3.45, -0.15, 2.5125},
    {3.45, 0, 2.5125},
    {2.8, 0, 2.4},
    {2.8, -0.15, 2.4},
    {3.2, -0.15, 2.4},
    {3.2, 0, 2.4},
    {0, 0, 3.15},
    {0.8, 0, 3.15},
    {0.8, -0.45, 3.15},
    {0.45, -0.8, 3.15},
    {0, -0.8, 3.15},
    {0, 0, 2.85},
    {1.4, 0, 2.4},
    {1.4, -0.784, 2.4},
    {0.784, -1.4, 2.4},
    {0, -1.4, 2.4},
    {0.4, 0, 2.55},
    {0.4, -0.224, 2.55},
    {0.224, -0.4, 2.55},
    {0, -0.4, 2.55},
    {1.3, 0, 2.55},
    {1.3, -0.728, 2.55},
    {0.728, -1.3, 2.55},
    {0, -1.3, 2.55},
    {1.3, 0, 2.4},
    {1.3, -0.728, 2.4},
    {0.728, -1.3, 2.4},
    {0, -1.3, 2.4},
    {0, 0, 0},
    {1.425, -0.798, 0},
    {1.5, 0, 0.075},
    {1.425, 0, 0},
    {0.798, -1.425, 0},
    {0, -1.5, 0.075},
    {0, -1.425, 0},
    {1.5, -0.84, 0.075},
    {0.84, -1.5, 0.075},
}};

using Patch = std::array<std::size_t, 16>;  // four rows of four control points

// A quarter of the rim, the body (2), the lid (2) and the bottom: rows go down the outside or up it, columns
// round the axis.
constexpr std::array<Patch, 6> kQuarters{{
    {102, 103, 104, 105, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15},
    {12, 13, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 27},
    {24, 25, 26, 27, 29, 30, 31, 32, 33, 34, 35, 36, 37, 38, 39, 40},
    {96, 96, 96, 96, 97, 98, 99, 100, 101, 101, 101, 101, 0, 1, 2, 3},
    {0, 1, 2, 3, 106, 107, 108, 109, 110, 111, 112, 113, 114, 115, 116, 117},
    {37, 38, 39, 40, 120, 125, 126, 123, 121, 119, 122, 124, 118, 118, 118, 118},
}};

// Half (y <= 0) of the handle and of the spout: rows go along it, columns round it.
using Tube = std::array<Patch, 2>;
constexpr Tube kHandle{{{41, 42, 43, 44, 45, 46, 47, 48, 49, 50, 51, 52, 53, 54, 55, 56},
                        {53, 54, 55, 56, 57, 58, 59, 60, 61, 62, 63, 64, 28, 65, 66, 67}}};
constexpr Tube kSpout{{{68, 69, 70, 71, 72, 73, 74, 75, 76, 77, 78, 79, 80, 81, 82, 83},
                       {80, 81, 82, 83, 84, 85, 86, 87, 88, 89, 90, 91, 92, 93, 94, 95}}};

struct Bernstein {
  std::array<double, 4> value;
  std::array<double, 4> slope;
};

// Exactly one control point at either end, so that neighboring patches agree.
Bernstein bernstein(uint32_t i, uint32_t n) {
  const double t = static_cast<double>(i) / n, s = 1 - t;
  return {{s * s * s, 3 * t * s * s, 3 * t * t * s, t * t * t},
          {-3 * s * s, 3 * s * (s - 2 * t), 3 * t * (2 * s - t), 3 * t * t}};
}

// Point and normal of a patch at row i and column j of n. All patches are laid so that d/dcolumn x d/drow
// looks out.
ShapePoint evaluate(const Patch& patch, uint32_t i, uint32_t j, uint32_t n) {
  const Bernstein row = bernstein(i, n), column = bernstein(j, n);
  dvec3 position(0), alongRow(0), alongColumn(0);
  for (std::size_t r = 0; r < 4; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      const auto& control = kControlPoints[patch[4 * r + c]];
      const dvec3 p(control[0], control[1], control[2]);
      position += row.value[r] * column.value[c] * p;
      alongRow += row.slope[r] * column.value[c] * p;
      alongColumn += row.value[r] * column.slope[c] * p;
    }
  }
  const dvec3 normal = glm::cross(alongColumn, alongRow);
  const double length = glm::length(normal);
  // Where a whole row is one point (the top of the lid, the middle of the bottom) the surface is level.
  if (length < 1e-12) return {position, {0, 0, position.z > 1 ? 1 : -1}};
  return {position, normal / length};
}

// From the data's axes to ours: z up becomes y up.
ShapePoint upright(const ShapePoint& p) {
  return {{p.position.x, p.position.z, -p.position.y}, {p.normal.x, p.normal.z, -p.normal.y}};
}

dvec3 quarterTurns(dvec3 p, uint32_t turns) {
  for (; turns > 0; --turns) p = {p.y, -p.x, p.z};
  return p;
}

void addQuarters(Mesh& mesh, uint32_t n) {
  for (const Patch& patch : kQuarters) {
    for (uint32_t turns = 0; turns < 4; ++turns) {
      addGrid(mesh, n, n, [&](uint32_t j, uint32_t i) {
        const ShapePoint p = evaluate(patch, i, j, n);
        return upright({quarterTurns(p.position, turns), quarterTurns(p.normal, turns)});
      });
    }
  }
}

// The flat strip from the lid's edge to the rim's, which the original leaves open.
void addLidGap(Mesh& mesh, uint32_t n) {
  for (uint32_t turns = 0; turns < 4; ++turns) {
    addGrid(mesh, n, 1, [&](uint32_t j, uint32_t i) {
      const dvec3 p =
          i == 0 ? evaluate(kQuarters[4], n, j, n).position : evaluate(kQuarters[0], 0, j, n).position;
      return upright({quarterTurns(p, turns), {0, 0, 1}});
    });
  }
}

// Both halves of a tube, then the flat cap on either end.
void addTube(Mesh& mesh, const Tube& tube, uint32_t n) {
  const auto mirrored = [](dvec3 p) { return dvec3(p.x, -p.y, p.z); };
  for (const Patch& patch : tube) {
    addGrid(mesh, n, n, [&](uint32_t j, uint32_t i) { return upright(evaluate(patch, i, j, n)); });
    addGrid(mesh, n, n, [&](uint32_t i, uint32_t j) {
      const ShapePoint p = evaluate(patch, i, j, n);
      return upright({mirrored(p.position), mirrored(p.normal)});
    });
  }
  for (const bool isStart : {true, false}) {
    const Patch& patch = tube[isStart ? 0 : 1];
    std::vector<dvec3> rim;  // once round
    for (uint32_t j = 0; j <= n; ++j) rim.push_back(evaluate(patch, isStart ? 0 : n, j, n).position);
    for (uint32_t j = n - 1; j > 0; --j) rim.push_back(mirrored(rim[j]));
    dvec3 center(0), normal(0);
    for (std::size_t j = 0; j < rim.size(); ++j) {
      center += rim[j] / static_cast<double>(rim.size());
      normal += glm::cross(rim[j], rim[(j + 1) % rim.size()]);
    }
    normal = (isStart ? -1.0 : 1.0) * glm::normalize(normal);
    const uint32_t middle = addVertex(mesh, upright({center, normal}));
    for (const dvec3 p : rim) addVertex(mesh, upright({p, normal}));
    const auto count = static_cast<uint32_t>(rim.size());
    for (uint32_t j = 0; j < count; ++j) {
      const uint32_t a = middle + 1 + j, b = middle + 1 + (j + 1) % count;
      mesh.triangles.emplace_back(middle, isStart ? b : a, isStart ? a : b);
    }
  }
}

}  // namespace

Mesh makeTeapot(float size, Density density) {
  const auto count = [](uint64_t n) { return 32 * n * n + 30 * n; };  // nearly
  uint32_t n = kDefaultSegments;
  if (density.segments > 0) n = parts(density.segments, 4, kFewestSegments);
  if (density.vertices > 0) n = partsForVertices(density.vertices, kFewestSegments, count);
  Mesh mesh;
  mesh.name = "teapot";
  addQuarters(mesh, n);
  addLidGap(mesh, n);
  addTube(mesh, kHandle, n);
  addTube(mesh, kSpout, n);
  const Box box = boundingBox(mesh);
  const float scale = size / box.longestSide();
  for (vec3& p : mesh.positions) p = scale * (p - box.center());
  mesh.isCurved = true;
  finishMesh(mesh, mesh.name);
  return mesh;
}

}  // namespace nephroid
