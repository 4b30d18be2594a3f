#include "geometry/mesh_checks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <unordered_map>

#include "core/error.h"
#include "geometry/creases.h"
#include "geometry/mesh_edges.h"
#include "geometry/mesh_repairs.h"
#include "geometry/triangle_area.h"

namespace nephroid {
namespace {

using dvec3 = glm::dvec3;

// Bytes as the key: -0 is made 0, and NaN never gets here.
struct VertexKey {
  std::array<float, 8> values{};
  bool operator==(const VertexKey&) const = default;
};

struct VertexKeyHash {
  std::size_t operator()(const VertexKey& key) const {
    std::size_t hash = 0x9e3779b97f4a7c15ull;
    for (const float value : key.values)
      hash = (hash ^ std::hash<float>{}(value)) * 0x100000001b3ull + (hash >> 29);
    return hash;
  }
};

VertexKey keyOf(vec3 position) {
  VertexKey key;
  for (int i = 0; i < 3; ++i) key.values[static_cast<std::size_t>(i)] = position[i] + 0.0f;
  return key;
}

VertexKey keyOf(const Mesh& mesh, std::size_t i) {
  VertexKey key = keyOf(mesh.positions[i]);
  for (int k = 0; k < 3 && !mesh.normals.empty(); ++k)
    key.values[static_cast<std::size_t>(3 + k)] = mesh.normals[i][k];
  for (int k = 0; k < 2 && !mesh.texcoords.empty(); ++k)
    key.values[static_cast<std::size_t>(6 + k)] = mesh.texcoords[i][k];
  return key;
}

bool isFinite(vec3 v) {
  return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}

void requireUsable(const Mesh& mesh, const std::string& source) {
  if (mesh.positions.empty()) throw InputError(source + ": the mesh has no vertices");
  if (mesh.triangles.empty()) throw InputError(source + ": the mesh has no triangles");
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    if (!isFinite(mesh.positions[i])) {
      throw InputError(source + ": vertex " + std::to_string(i) +
                       " is not finite; all coordinates must be numbers");
    }
    if (glm::any(glm::greaterThan(glm::abs(mesh.positions[i]), vec3(kLargestCoordinate)))) {
      throw InputError(source + ": vertex " + std::to_string(i) + " is farther than 1e9 m from the origin");
    }
  }
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const uvec3 t = mesh.triangles[i];
    if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) {
      throw InputError(source + ": triangle " + std::to_string(i) + " refers to vertex " +
                       std::to_string(std::max({t.x, t.y, t.z})) + "; there are " +
                       std::to_string(mesh.positions.size()));
    }
  }
}

void requireFinished(const Mesh& mesh, const std::string& source) {
  constexpr float kUnitTolerance = 1e-3f;
  if (!mesh.isFinished) throw InputError(source + ": the mesh is not finished; call finishMesh");
  if (mesh.normals.size() != mesh.positions.size())
    throw InputError(source + ": " + std::to_string(mesh.normals.size()) + " normals for " +
                     std::to_string(mesh.positions.size()) + " vertices; each vertex must have one");
  if (!mesh.texcoords.empty() && mesh.texcoords.size() != mesh.positions.size())
    throw InputError(source + ": " + std::to_string(mesh.texcoords.size()) + " texture coordinates for " +
                     std::to_string(mesh.positions.size()) + " vertices; each vertex must have one, or none");
  for (std::size_t i = 0; i < mesh.normals.size(); ++i)
    if (!(std::abs(glm::length(mesh.normals[i]) - 1) <= kUnitTolerance))
      throw InputError(source + ": the normal of vertex " + std::to_string(i) + " is not of length 1");
  for (std::size_t i = 0; i < mesh.texcoords.size(); ++i)
    if (!std::isfinite(mesh.texcoords[i].x) || !std::isfinite(mesh.texcoords[i].y))
      throw InputError(source + ": the texture coordinate of vertex " + std::to_string(i) + " is not finite");
}

bool hasUsableNormals(const Mesh& mesh) {
  if (mesh.normals.size() != mesh.positions.size()) return false;
  return std::all_of(mesh.normals.begin(), mesh.normals.end(), [](vec3 n) {
    const float length = glm::length(n);
    return std::isfinite(length) && length > 1e-6f;
  });
}

void mergeEqualVertices(Mesh& mesh) {
  std::unordered_map<VertexKey, uint32_t, VertexKeyHash> known;
  known.reserve(mesh.positions.size());
  Mesh merged;
  for (uvec3& triangle : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      const uint32_t old = triangle[k];
      const auto [entry, isNew] =
          known.try_emplace(keyOf(mesh, old), static_cast<uint32_t>(merged.positions.size()));
      triangle[k] = entry->second;
      if (!isNew) continue;
      merged.positions.push_back(mesh.positions[old]);
      if (!mesh.normals.empty()) merged.normals.push_back(mesh.normals[old]);
      if (!mesh.texcoords.empty()) merged.texcoords.push_back(mesh.texcoords[old]);
    }
  }
  mesh.positions = std::move(merged.positions);
  mesh.normals = std::move(merged.normals);
  mesh.texcoords = std::move(merged.texcoords);
}

void averageNormals(Mesh& mesh) {
  const std::vector<uint32_t> joined = joinEqualPositions(mesh.positions);
  std::vector<dvec3> sums(mesh.positions.size(), dvec3(0));
  for (const uvec3 t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) sums[joined[t[k]]] += areaVector(mesh, t);
  }
  mesh.normals.assign(mesh.positions.size(), vec3(0));
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const double length = glm::length(sums[joined[i]]);
    if (length > 0) mesh.normals[i] = vec3(sums[joined[i]] / length);
  }
  // The faces around a vertex may cancel out (two sides of a sheet): any of them is as good.
  for (const uvec3 t : mesh.triangles) {
    for (int k = 0; k < 3; ++k) {
      if (mesh.normals[t[k]] == vec3(0)) mesh.normals[t[k]] = vec3(glm::normalize(areaVector(mesh, t)));
    }
  }
}

float facetedPart(const Mesh& mesh) {
  constexpr float kEven = 1 - 1e-6f;  // cosine
  double area = 0, evenArea = 0;
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x];
    const vec3 doubledArea = cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    const float doubled = length(doubledArea);
    area += double(doubled);
    const bool isEven = std::ranges::all_of(std::array{t.x, t.y, t.z}, [&](uint32_t corner) {
      return dot(mesh.normals[corner], doubledArea) >= kEven * doubled;
    });
    if (isEven) evenArea += double(doubled);
  }
  return area > 0 ? float(evenArea / area) : 0;
}

// Sets the numbers of edges that are not as in a closed mesh.
template <class Counts>
void countEdges(const MeshEdges& edges, Counts& counts) {
  counts.boundaryEdges = counts.nonManifoldEdges = counts.flippedEdges = 0;
  for (std::size_t edge = 0; edge < edges.count(); ++edge) {
    const auto sides = edges.sidesOf(edge);
    counts.boundaryEdges += sides.size() == 1;
    counts.nonManifoldEdges += sides.size() > 2;
    counts.flippedEdges += sides.size() == 2 && edges.runAlike(sides[0], sides[1]);
  }
}

// Edges are found anew only where something was mended.
void mendFaces(Mesh& mesh, Faces faces) {
  std::vector<uint32_t> joined = joinEqualPositions(mesh.positions);
  MeshEdges edges(mesh.triangles, joined);
  if (closeSeams(mesh, edges, joined)) edges = MeshEdges(mesh.triangles, joined);
  if (dropRepeatedTriangles(mesh, edges, joined)) edges = MeshEdges(mesh.triangles, joined);
  countEdges(edges, mesh.findings);
  mesh.isClosed = mesh.findings.boundaryEdges == 0 && mesh.findings.nonManifoldEdges == 0;
  if (orientParts(mesh, edges, faces))
    countEdges(MeshEdges(mesh.triangles, joinEqualPositions(mesh.positions)), mesh.findings);
}

}  // namespace

std::vector<uint32_t> joinEqualPositions(const std::vector<vec3>& positions) {
  std::unordered_map<VertexKey, uint32_t, VertexKeyHash> first;
  first.reserve(positions.size());
  std::vector<uint32_t> joined(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    joined[i] = first.try_emplace(keyOf(positions[i]), static_cast<uint32_t>(i)).first->second;
  }
  return joined;
}

MeshTopology meshTopology(const Mesh& mesh) {
  const std::vector<uint32_t> joined = joinEqualPositions(mesh.positions);
  MeshTopology topology;
  countEdges(MeshEdges(mesh.triangles, joined), topology);
  for (const uvec3 t : mesh.triangles) {
    if (joined[t.x] == joined[t.y] || joined[t.y] == joined[t.z] || joined[t.z] == joined[t.x]) continue;
    topology.area += glm::length(areaVector(mesh, t));
    topology.signedVolume += glm::dot(dvec3(mesh.positions[t.x]), areaVector(mesh, t)) / 3;
  }
  return topology;
}

void checkMesh(const Mesh& mesh, const std::string& source) {
  requireUsable(mesh, source);
  requireFinished(mesh, source);
}

void finishMesh(Mesh& mesh, const std::string& source, Faces faces) {
  requireUsable(mesh, source);
  if (!hasUsableNormals(mesh)) mesh.normals.clear();
  for (vec3& n : mesh.normals) n = glm::normalize(n);
  // A flat triangle between three different vertices still holds its neighbors together, so the mesh is
  // judged before it goes.
  mendFaces(mesh, faces);
  const std::size_t given = mesh.triangles.size();
  std::erase_if(mesh.triangles, [&](uvec3 t) { return hasNoArea(mesh, t); });
  mesh.droppedTriangles += static_cast<uint32_t>(given - mesh.triangles.size());
  if (mesh.triangles.empty()) throw InputError(source + ": every triangle of the mesh has zero area");
  mergeEqualVertices(mesh);
  if (mesh.normals.empty()) averageNormals(mesh);
  if (!mesh.isCurved) mesh.findings.splitVertices = splitAtCreases(mesh);
  mesh.facetedPart = facetedPart(mesh);
  mesh.isFinished = true;
}

}  // namespace nephroid
