#include "scene/mesh_simplify.h"

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModNormalFlippingT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>

#include "core/error.h"
#include "scene/mesh_checks.h"

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

}  // namespace

Mesh simplified(const Mesh& mesh, uint32_t vertices, const std::string& where) {
  if (mesh.positions.size() <= vertices) return mesh;
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
  finishMesh(result, where);
  result.droppedTriangles += mesh.droppedTriangles;
  return result;
}

}  // namespace nephroid
