#include "beams/ray_mesh/lamp_on_surface.h"

#include <algorithm>
#include <limits>

#include "geometry/curved_triangle.h"

namespace nephroid {
namespace {

// Of a triangle's longest side: how far beside the surface light begins.
constexpr float kBeside = 0.01f;
// Of a mesh's diagonal: how far curved surfaces reach out of the box of its triangles, at most.
constexpr float kBulge = 0.05f;
// A point on the surface is as near to it as so many times what floats round.
constexpr float kRoundings = 16;

// Weights of the corners at the point of a triangle that is nearest to `point`.
vec3 nearestWeights(const mat3& corners, vec3 point) {
  const vec3 within = barycentricOf(point, corners);
  if (glm::all(glm::greaterThanEqual(within, vec3(0)))) return within;
  vec3 best(1, 0, 0);
  float least = std::numeric_limits<float>::infinity();
  for (int i = 0; i < 3; ++i) {
    const int j = (i + 1) % 3;
    const vec3 side = corners[j] - corners[i];
    const float along =
        std::clamp(dot(point - corners[i], side) / std::max(dot(side, side), 1e-30f), 0.0f, 1.0f);
    const float away = distance(point, corners[i] + along * side);
    if (away >= least) continue;
    least = away;
    best = vec3(0);
    best[i] = 1 - along;
    best[j] = along;
  }
  return best;
}

// All in the mesh's own space.
bool liesOn(const mat3& positions, const mat3& normals, bool isCurved, vec3 point, float rounding,
            vec3& outside) {
  const vec3 weights = nearestWeights(positions, point);
  const vec3 flat = positions * weights;
  const vec3 bulge = isCurved ? curvedOffset(flat, weights, positions, normals) : vec3(0);
  const float spare = kRoundings * rounding;
  // The curved surface is itself not the one that the mesh was made from.
  if (distance(point, flat + 0.5f * bulge) > length(bulge) + spare) return false;
  const vec3 normal = normalize(normals * weights);
  const float longest = std::max({distance(positions[0], positions[1]), distance(positions[1], positions[2]),
                                  distance(positions[2], positions[0])});
  outside = flat + bulge + std::max(kBeside * longest, spare) * normal;
  return true;
}

}  // namespace

vec3 besideSurfaces(const Scene& scene, const RayScene& rays, vec3 point) {
  for (uint32_t index = 0; index < scene.objects.size(); ++index) {
    const Object& object = scene.objects[index];
    if (!scene.isCaster(object)) continue;
    const Placement& placement = object.placement;
    const Mesh& mesh = scene.meshOf(object);
    const vec3 local = placement.inversePoint(point);
    const float rounding = rays.rounding(index) / placement.scale;
    Box near = rays.box(object.mesh);
    const float spare = kBulge * near.diagonal();
    near.low -= spare;
    near.high += spare;
    if (glm::any(glm::lessThan(local, near.low)) || glm::any(glm::greaterThan(local, near.high))) continue;
    for (const uvec3& c : mesh.triangles) {
      const mat3 positions(mesh.positions[c.x], mesh.positions[c.y], mesh.positions[c.z]);
      const mat3 normals(mesh.normals[c.x], mesh.normals[c.y], mesh.normals[c.z]);
      vec3 outside;
      if (liesOn(positions, normals, mesh.isCurved, local, rounding, outside))
        return placement.point(outside);
    }
  }
  return point;
}

}  // namespace nephroid
