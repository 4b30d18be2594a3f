#include <algorithm>
#include <functional>

#include "trace/ray_scene.h"
#include "transport/follow.h"
#include "transport/table/fill.h"

namespace nephroid {
namespace {

// The smooth surface of each vertex. Vertices on an edge between two are there twice, with a normal each.
std::vector<uint32_t> vertexPatches(const Mesh& mesh, const RayScene& rays) {
  std::vector<uint32_t> patches(mesh.positions.size(), 0);
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (int corner = 0; corner < 3; ++corner) patches[mesh.triangles[t][corner]] = rays.patchOf(0, t);
  }
  return patches;
}

}  // namespace

TransportTable buildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress) {
  const TableKey key = tableKey(mesh, ior, settings);
  const RayScene rayScene(mesh);
  const std::vector<uint32_t> patches = vertexPatches(mesh, rayScene);
  const float margin = 10 * rayScene.rounding(0);
  const auto trace = [&](uint32_t vertex, float bandIor, std::span<const vec3> directions,
                         std::span<OutgoingRay> rays) {
    Material clear;
    clear.type = MaterialType::dielectric;
    clear.ior = vec3(bandIor);
    const Follower follower(rayScene, {&clear});
    const vec3& position = mesh.positions[vertex];
    const vec3& normal = mesh.normals[vertex];
    const SurfacePoint entry{position, position, normal, normal, patches[vertex]};
    std::vector<vec3> toLight(directions.size());
    std::vector<uint8_t> isOccluded(directions.size());
    std::transform(directions.begin(), directions.end(), toLight.begin(), std::negate<>());
    rayScene.occluded(entry.position, toLight, margin, isOccluded);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      rays[i] = follower.follow(entry, 0, directions[i], {}, {});
      if (isOccluded[i]) rays[i].flags |= kRayOccluded;
    }
  };
  return fillTable(key, mesh, trace, progress);
}

}  // namespace nephroid
