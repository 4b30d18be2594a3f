#pragma once

#include <cmath>
#include <numbers>

#include "optics/refraction.h"
#include "scene/scene.h"
#include "transport/outgoing_ray.h"

namespace nephroid {

inline constexpr float kPi = std::numbers::pi_v<float>;

// A ball around `center` of (rings + 1) (2 rings + 1) vertices with exact normals, added to `mesh`.
inline void addBall(Mesh& mesh, vec3 center, float radius, uint32_t rings) {
  mesh.isFinished = true;
  const auto first = static_cast<uint32_t>(mesh.positions.size());
  const uint32_t row = 2 * rings + 1;
  for (uint32_t i = 0; i <= rings; ++i) {
    for (uint32_t j = 0; j < row; ++j) {
      const float polar = kPi * float(i) / float(rings);
      const float azimuth = kPi * float(j) / float(rings);
      const vec3 normal = normalize(
          vec3(std::sin(polar) * std::cos(azimuth), std::cos(polar), std::sin(polar) * std::sin(azimuth)));
      mesh.positions.push_back(center + radius * normal);
      mesh.normals.push_back(normal);
    }
  }
  for (uint32_t i = 0; i < rings; ++i) {
    for (uint32_t j = 0; j + 1 < row; ++j) {
      const uint32_t a = first + i * row + j;
      if (i > 0) mesh.triangles.push_back({a, a + 1, a + row});
      if (i + 1 < rings) mesh.triangles.push_back({a + 1, a + row + 1, a + row});
    }
  }
}

inline Mesh ballMesh(uint32_t rings, float radius = 1) {
  Mesh mesh;
  mesh.name = "ball";
  addBall(mesh, vec3(0), radius, rings);
  return mesh;
}

// The closed form: light through a ball around the origin, refracted where it enters and where it leaves.
inline OutgoingRay rayThroughBall(vec3 entry, vec3 direction, float radius, float ior) {
  const vec3 normal = entry / radius;
  OutgoingRay ray{};
  vec3 inside;
  refractDirection(direction, normal, 1 / ior, inside);
  ray.pathLength = -2 * radius * dot(inside, normal);
  ray.position = entry + ray.pathLength * inside;
  refractDirection(inside, -ray.position / radius, ior, ray.direction);
  const float entering = 1 - fresnelReflectance(-dot(direction, normal), 1 / ior);
  ray.transmittance = vec3(entering * entering);  // the way out is the way in, reversed
  return ray;
}

}  // namespace nephroid
