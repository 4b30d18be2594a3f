// Small meshes for tests, centerd on the origin.
#pragma once

#include "scene/scene.h"

namespace nephroid {

// Faces +y.
inline Mesh plane(float halfSize) {
  Mesh mesh;
  mesh.positions = {
      {-halfSize, 0, -halfSize}, {-halfSize, 0, halfSize}, {halfSize, 0, halfSize}, {halfSize, 0, -halfSize}};
  mesh.normals.assign(4, vec3(0, 1, 0));
  mesh.texcoords = {{0, 0}, {0, 1}, {1, 1}, {1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.isFinished = true;
  return mesh;
}

inline Mesh box(vec3 halfSize) {
  Mesh mesh;
  for (int axis = 0; axis < 3; ++axis)
    for (const float side : {-1.0f, 1.0f}) {
      vec3 n(0), a(0), b(0);
      n[axis] = side;
      a[(axis + 1) % 3] = 1;
      b = cross(n, a);
      const auto first = static_cast<uint32_t>(mesh.positions.size());
      for (const vec2 s : {vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1)}) {
        mesh.positions.push_back((n + s.x * a + s.y * b) * halfSize);
        mesh.normals.push_back(n);
      }
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
    }
  mesh.isClosed = mesh.isFinished = true;
  return mesh;
}

}  // namespace nephroid
