#include "geometry/mesh_density.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include <map>
#include <queue>

#include "core/error.h"
#include "geometry/mesh_checks.h"

namespace nephroid {
namespace {

constexpr float kMostTurn = 60;  // degrees, of a face by one collapse

using Edges = OpenMesh::TriMesh_ArrayKernelT<>;

Edges edgesOf(const Mesh& mesh, const std::string& where) {
  omerr().disable();  // what the library has to say is said below
  Edges edges;
  edges.request_face_normals();
  edges.request_vertex_status();
  edges.request_edge_status();
  edges.request_face_status();
  const std::vector<uint32_t> joined = joinEqualPositions(mesh.positions);
  std::vector<Edges::VertexHandle> vertices(mesh.positions.size());
  for (std::size_t i = 0; i < joined.size(); ++i) {
    const vec3 p = mesh.positions[i];
    vertices[i] = joined[i] == i ? edges.add_vertex({p.x, p.y, p.z}) : vertices[joined[i]];
  }
  for (const uvec3& t : mesh.triangles) {
    const auto a = vertices[t.x], b = vertices[t.y], c = vertices[t.z];
    if (a == b || b == c || c == a) continue;
    if (!edges.add_face(a, b, c).is_valid())
      throw InputError(where +
                       "the mesh cannot be simplified: some of its edges have more than two faces, or faces "
                       "that run against each other");
  }
  edges.delete_isolated_vertices();
  edges.garbage_collection();
  edges.update_face_normals();
  return edges;
}

Mesh simplified(const Mesh& mesh, uint32_t vertices, const std::string& where) {
  Edges edges = edgesOf(mesh, where);
  OpenMesh::Decimater::DecimaterT<Edges> decimater(edges);
  OpenMesh::Decimater::ModQuadricT<Edges>::Handle quadrics;
  decimater.add(quadrics);
  decimater.module(quadrics).unset_max_err();
  OpenMesh::Decimater::ModNormalFlippingT<Edges>::Handle flips;
  decimater.add(flips);
  decimater.module(flips).set_max_normal_deviation(kMostTurn);
  decimater.initialize();
  decimater.decimate_to(vertices);
  edges.garbage_collection();

  Mesh result;
  result.name = mesh.name;
  for (const auto vertex : edges.vertices()) {
    const auto& p = edges.point(vertex);
    result.positions.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto face : edges.faces()) {
    auto corner = edges.cfv_begin(face);
    const auto next = [&] { return static_cast<uint32_t>((corner++)->idx()); };
    const uint32_t a = next(), b = next(), c = next();
    result.triangles.emplace_back(a, b, c);
  }
  result.findings = mesh.findings;
  result.droppedTriangles = mesh.droppedTriangles;
  finishMesh(result, where, Faces::asGiven);
  return result;
}

// The two ends of an edge, the lower index first.
using Edge = std::pair<uint32_t, uint32_t>;

Edge edgeOf(uint32_t a, uint32_t b) {
  return {std::min(a, b), std::max(a, b)};
}

// Halves edges, longest first, of all faces that meet there: also of those that have vertices of their own.
class Refiner {
 public:
  explicit Refiner(const Mesh& mesh) : result_(mesh), joined_(joinEqualPositions(mesh.positions)) {
    for (uint32_t t = 0; t < result_.triangles.size(); ++t) addEdges(t);
  }

  Mesh refined(uint32_t vertices) {
    while (result_.positions.size() < vertices && !edges_.empty()) {
      const Edge longest = edges_.top().second;
      edges_.pop();
      halve(longest);
    }
    return std::move(result_);
  }

 private:
  Edge joinedEdge(const uvec3& triangle, int side) const {
    return edgeOf(joined_[triangle[side]], joined_[triangle[(side + 1) % 3]]);
  }

  void addEdges(uint32_t triangle) {
    for (int side = 0; side < 3; ++side) {
      const Edge edge = joinedEdge(result_.triangles[triangle], side);
      std::vector<uint32_t>& faces = faces_[edge];
      if (faces.empty())
        edges_.emplace(distance(result_.positions[edge.first], result_.positions[edge.second]), edge);
      faces.push_back(triangle);
    }
  }

  void removeEdges(uint32_t triangle) {
    for (int side = 0; side < 3; ++side)
      std::erase(faces_[joinedEdge(result_.triangles[triangle], side)], triangle);
  }

  uint32_t addMiddle(uint32_t a, uint32_t b) {
    result_.positions.push_back(0.5f * (result_.positions[a] + result_.positions[b]));
    result_.normals.push_back(normalize(result_.normals[a] + result_.normals[b]));
    if (!result_.texcoords.empty())
      result_.texcoords.push_back(0.5f * (result_.texcoords[a] + result_.texcoords[b]));
    return static_cast<uint32_t>(result_.positions.size()) - 1;
  }

  void halve(const Edge& edge) {
    const std::vector<uint32_t> faces = faces_[edge];
    const auto firstMiddle = static_cast<uint32_t>(result_.positions.size());
    std::map<Edge, uint32_t> middles;
    for (const uint32_t face : faces) {
      removeEdges(face);
      const uvec3 whole = result_.triangles[face];
      int side = 0;
      while (joinedEdge(whole, side) != edge) ++side;
      const uint32_t a = whole[side], b = whole[(side + 1) % 3];
      const auto [middle, isNew] = middles.try_emplace(edgeOf(a, b), 0);
      if (isNew) {
        middle->second = addMiddle(a, b);
        joined_.push_back(firstMiddle);
      }
      uvec3 first = whole, second = whole;
      first[(side + 1) % 3] = second[side] = middle->second;
      result_.triangles[face] = first;
      result_.triangles.push_back(second);
      addEdges(face);
      addEdges(static_cast<uint32_t>(result_.triangles.size()) - 1);
    }
  }

  Mesh result_;
  std::vector<uint32_t> joined_;                       // for each vertex, the first at its position
  std::map<Edge, std::vector<uint32_t>> faces_;        // by joined vertices
  std::priority_queue<std::pair<float, Edge>> edges_;  // by length
};

}  // namespace

Mesh withVertices(const Mesh& mesh, uint32_t vertices, const std::string& where) {
  if (vertices < mesh.positions.size()) return simplified(mesh, vertices, where);
  return Refiner(mesh).refined(vertices);
}

}  // namespace nephroid
