#include "geometry/creases.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "geometry/mesh_checks.h"
#include "geometry/mesh_edges.h"
#include "geometry/triangle_area.h"

namespace nephroid {
namespace {

using dvec3 = glm::dvec3;

std::vector<dvec3> flatNormals(const Mesh& mesh) {
  std::vector<dvec3> normals;
  normals.reserve(mesh.triangles.size());
  for (const uvec3& t : mesh.triangles) normals.push_back(glm::normalize(areaVector(mesh, t)));
  return normals;
}

// Of faces at an edge that are more than the crease's angle apart one is more than half of it off a common
// normal.
bool mayHaveCreases(const Mesh& mesh, const std::vector<dvec3>& flat) {
  const double least = std::cos(glm::radians(0.5 * double(kCreaseAngle)));
  for (std::size_t t = 0; t < flat.size(); ++t)
    for (int k = 0; k < 3; ++k)
      if (dot(flat[t], dvec3(mesh.normals[mesh.triangles[t][k]])) < least) return true;
  return false;
}

// rad, of a triangle at one of its corners.
double angleAt(const Mesh& mesh, uvec3 t, int corner) {
  const dvec3 at = mesh.positions[t[corner]];
  const dvec3 a = dvec3(mesh.positions[t[(corner + 1) % 3]]) - at;
  const dvec3 b = dvec3(mesh.positions[t[(corner + 2) % 3]]) - at;
  return std::atan2(length(cross(a, b)), dot(a, b));
}

// The corners of triangles, 3 * triangle + place in it. Those around a vertex belong together that edges
// without a crease join.
class SmoothCorners {
 public:
  SmoothCorners(const Mesh& mesh, const std::vector<dvec3>& flat) : parent_(3 * mesh.triangles.size()) {
    std::iota(parent_.begin(), parent_.end(), 0u);
    const MeshEdges edges(mesh.triangles, joinEqualPositions(mesh.positions));
    std::vector<float> angles;  // rad, that each side is bent by
    angles.resize(3 * mesh.triangles.size());
    const auto forJoined = [&](auto&& use) {
      for (std::size_t edge = 0; edge < edges.count(); ++edge) {
        const auto sides = edges.sidesOf(edge);
        if (sides.size() == 2 && !edges.runAlike(sides[0], sides[1])) use(sides[0], sides[1]);
      }
    };
    forJoined([&](uint32_t a, uint32_t b) {
      const double cosine = std::clamp(dot(flat[a / 3], flat[b / 3]), -1.0, 1.0);
      angles[a] = angles[b] = float(std::acos(cosine));
    });
    forJoined([&](uint32_t a, uint32_t b) {
      if (isCrease(angles, a) && isCrease(angles, b)) return;
      join(a, after(b));
      join(after(a), b);
    });
  }

  uint32_t groupOf(uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }

 private:
  // Bent far more than the triangle's other sides are, unless these are as sharp: where a body is round and
  // its triangles are coarse, they all bend.
  static bool isCrease(const std::vector<float>& angles, uint32_t side) {
    const float sharp = glm::radians(kCreaseAngle), own = angles[side];
    const auto stays = [&](float other) { return other < 0.5f * own || other > sharp; };
    return own > sharp && stays(angles[after(side)]) && stays(angles[after(after(side))]);
  }
  static uint32_t after(uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
  void join(uint32_t a, uint32_t b) { parent_[groupOf(b)] = groupOf(a); }

  std::vector<uint32_t> parent_;
};

}  // namespace

uint32_t splitAtCreases(Mesh& mesh) {
  const std::vector<dvec3> flat = flatNormals(mesh);
  if (!mayHaveCreases(mesh, flat)) return 0;
  SmoothCorners corners(mesh, flat);
  std::vector<dvec3> sums(3 * mesh.triangles.size(), dvec3(0));  // by group
  for (uint32_t corner = 0; corner < sums.size(); ++corner)
    sums[corners.groupOf(corner)] +=
        angleAt(mesh, mesh.triangles[corner / 3], int(corner % 3)) * flat[corner / 3];

  struct Use {
    uint32_t vertex, group, corner;
  };
  std::vector<Use> uses;
  uses.reserve(sums.size());
  for (uint32_t corner = 0; corner < sums.size(); ++corner)
    uses.push_back({mesh.triangles[corner / 3][int(corner % 3)], corners.groupOf(corner), corner});
  std::sort(uses.begin(), uses.end(), [](const Use& a, const Use& b) {
    return std::tie(a.vertex, a.group, a.corner) < std::tie(b.vertex, b.group, b.corner);
  });
  const auto given = uint32_t(mesh.positions.size());
  for (std::size_t first = 0, last = 0; first < uses.size(); first = last) {
    const uint32_t vertex = uses[first].vertex;
    while (last < uses.size() && uses[last].vertex == vertex) ++last;
    if (uses[first].group == uses[last - 1].group) continue;
    for (std::size_t i = first; i < last; ++i) {
      const bool isNew = i > first && uses[i].group != uses[i - 1].group;
      if (isNew) {
        mesh.positions.push_back(mesh.positions[vertex]);
        mesh.normals.push_back(mesh.normals[vertex]);
        if (!mesh.texcoords.empty()) mesh.texcoords.push_back(mesh.texcoords[vertex]);
      }
      const uint32_t own = uses[i].group == uses[first].group ? vertex : uint32_t(mesh.positions.size() - 1);
      mesh.triangles[uses[i].corner / 3][int(uses[i].corner % 3)] = own;
      const dvec3& sum = sums[uses[i].group];
      if (length(sum) > 0) mesh.normals[own] = vec3(normalize(sum));
    }
  }
  return uint32_t(mesh.positions.size()) - given;
}

}  // namespace nephroid
