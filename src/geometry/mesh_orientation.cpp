// Closed parts of a mesh that are turned inside out.
#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/mesh_repairs.h"
#include "geometry/triangle_area.h"

namespace nephroid {
namespace {

constexpr uint32_t kNoPart = UINT32_MAX;
constexpr uint32_t kNoSide = UINT32_MAX;
// m3 for m2 to the power of 3/2: what holds less than this has no inside.
constexpr double kLeastFullness = 1e-9;

// Triangles that hang together by edges with two faces each.
struct Part {
  bool isClosed = true;
  bool isTwoSided = true;     // unlike a Klein bottle
  double volume = 0;          // m3, were all its triangles to run as its first
  double area = 0;            // m2
  uint32_t againstFirst = 0;  // triangles that do not
  uint32_t triangles = 0;

  bool hasInside() const {
    return isClosed && isTwoSided && std::abs(volume) > kLeastFullness * std::pow(area, 1.5);
  }
  uint32_t wrongTriangles() const {
    if (!hasInside()) return 0;
    return volume < 0 ? triangles - againstFirst : againstFirst;
  }
};

class MeshParts {
 public:
  MeshParts(const Mesh& mesh, const MeshEdges& edges)
      : partOf(mesh.triangles.size(), kNoPart), runsAgainst_(mesh.triangles.size(), 0), mesh_(mesh) {
    across_.assign(3 * mesh.triangles.size(), kNoSide);
    hasSides_.assign(mesh.triangles.size(), 0);
    isAtRim_.assign(mesh.triangles.size(), 0);
    for (std::size_t edge = 0; edge < edges.count(); ++edge) {
      const auto sides = edges.sidesOf(edge);
      for (const uint32_t side : sides) hasSides_[side / 3] = 1;
      if (sides.size() == 2) {
        across_[sides[0]] = sides[1];
        across_[sides[1]] = sides[0];
      } else {
        for (const uint32_t side : sides) isAtRim_[side / 3] = 1;
      }
    }
    for (uint32_t t = 0; t < partOf.size(); ++t)
      if (hasSides_[t] && partOf[t] == kNoPart) spreadFrom(t, edges);
  }

  // Whether the triangle has to be turned for its part to look outward.
  bool isWrong(uint32_t triangle) const {
    if (partOf[triangle] == kNoPart) return false;
    const Part& part = parts[partOf[triangle]];
    return part.hasInside() && (runsAgainst_[triangle] != 0) != (part.volume < 0);
  }

  std::vector<Part> parts;
  std::vector<uint32_t> partOf;  // of each triangle

 private:
  void spreadFrom(uint32_t seed, const MeshEdges& edges) {
    const auto number = uint32_t(parts.size());
    Part& part = parts.emplace_back();
    reached_.assign(1, seed);
    partOf[seed] = number;
    while (!reached_.empty()) {
      const uint32_t t = reached_.back();
      reached_.pop_back();
      add(t, part);
      for (uint32_t side = 3 * t; side < 3 * t + 3; ++side) {
        if (across_[side] == kNoSide) continue;
        const uint32_t other = across_[side] / 3;
        const uint8_t against = runsAgainst_[t] ^ uint8_t(edges.runAlike(side, across_[side]));
        if (partOf[other] == kNoPart) {
          partOf[other] = number;
          runsAgainst_[other] = against;
          reached_.push_back(other);
        } else if (runsAgainst_[other] != against) {
          part.isTwoSided = false;
        }
      }
    }
  }

  void add(uint32_t t, Part& part) const {
    const glm::dvec3 area = areaVector(mesh_, mesh_.triangles[t]);
    const double volume = glm::dot(glm::dvec3(mesh_.positions[mesh_.triangles[t].x]), area) / 3;
    part.volume += runsAgainst_[t] ? -volume : volume;
    part.area += glm::length(area);
    part.againstFirst += runsAgainst_[t];
    ++part.triangles;
    if (isAtRim_[t]) part.isClosed = false;
  }

  std::vector<uint8_t> runsAgainst_;  // the first triangle of its part
  const Mesh& mesh_;
  std::vector<uint32_t> across_;  // of each side, the one of the only other triangle at its edge
  std::vector<uint8_t> hasSides_, isAtRim_;
  std::vector<uint32_t> reached_;
};

// Gives vertices that a turned part shares with others to each of them alone. The part of each vertex.
std::vector<uint32_t> partVertices(Mesh& mesh, const MeshParts& parts, const std::vector<bool>& isTurned) {
  std::vector<uint32_t> owner(mesh.positions.size(), kNoPart);
  std::map<std::pair<uint32_t, uint32_t>, uint32_t> copies;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const uint32_t part = parts.partOf[t];
    if (part == kNoPart) continue;
    for (int k = 0; k < 3; ++k) {
      uint32_t& vertex = mesh.triangles[t][k];
      if (owner[vertex] == kNoPart) owner[vertex] = part;
      if (owner[vertex] == part || !(isTurned[part] || isTurned[owner[vertex]])) continue;
      const auto [copy, isNew] = copies.try_emplace({vertex, part}, uint32_t(mesh.positions.size()));
      if (isNew) {
        mesh.positions.push_back(mesh.positions[vertex]);
        mesh.normals.push_back(mesh.normals[vertex]);
        if (!mesh.texcoords.empty()) mesh.texcoords.push_back(mesh.texcoords[vertex]);
        owner.push_back(part);
      }
      vertex = copy->second;
    }
  }
  return owner;
}

// Some exporters turn faces and leave the normals as they should be: those that agree with the turned faces
// stay.
void turnNormals(Mesh& mesh, const MeshParts& parts, const std::vector<bool>& isTurned) {
  const std::vector<uint32_t> owner = partVertices(mesh, parts, isTurned);
  std::vector<glm::dvec3> faces(mesh.positions.size(), glm::dvec3(0));
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (parts.partOf[t] == kNoPart || !isTurned[parts.partOf[t]]) continue;
    for (int k = 0; k < 3; ++k) faces[mesh.triangles[t][k]] += areaVector(mesh, mesh.triangles[t]);
  }
  for (std::size_t i = 0; i < owner.size(); ++i)
    if (owner[i] != kNoPart && isTurned[owner[i]] && glm::dot(faces[i], glm::dvec3(mesh.normals[i])) < 0)
      mesh.normals[i] = -mesh.normals[i];
}

}  // namespace

bool orientParts(Mesh& mesh, const MeshEdges& edges, Faces faces) {
  const MeshParts parts(mesh, edges);
  mesh.findings.closedParts = uint32_t(std::ranges::count_if(parts.parts, &Part::hasInside));
  if (faces == Faces::asGiven) {
    mesh.findings.inwardParts = uint32_t(std::ranges::count_if(
        parts.parts, [](const Part& part) { return part.wrongTriangles() == part.triangles; }));
    return false;
  }
  std::vector<bool> isTurned;
  for (const Part& part : parts.parts) {
    isTurned.push_back(part.wrongTriangles() > 0);
    mesh.findings.turnedTriangles += part.wrongTriangles();
    mesh.findings.turnedParts += isTurned.back();
  }
  if (std::ranges::find(isTurned, true) == isTurned.end()) return false;
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    if (parts.isWrong(t)) std::swap(mesh.triangles[t].y, mesh.triangles[t].z);
  if (!mesh.normals.empty()) turnNormals(mesh, parts, isTurned);
  return true;
}

}  // namespace nephroid
