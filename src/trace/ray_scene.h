// What a ray hits. Embree behind a plain face; nothing else includes it.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/shared_language.h"
#include "scene/scene.h"

namespace nephroid {

struct Ray {
  vec3 origin{0};     // m
  vec3 direction{0};  // unit
  float nearDistance = 0;
  float farDistance = std::numeric_limits<float>::infinity();
};

struct Hit {
  float distance = 0;       // m
  uint32_t object = kNone;  // index into Scene::objects, or 0 for a scene of one mesh
  uint32_t triangle = 0;
  uint32_t patch = 0;       // smooth surface of the mesh the triangle belongs to
  vec2 barycentric{0};      // weights of the triangle's second and third corner
  vec3 position{0};         // on the curved surface where the mesh has one
  vec3 flatPosition{0};     // on the triangle
  vec3 normal{0};           // unit, interpolated from the vertices
  vec3 geometricNormal{0};  // unit, outward by winding
};

// Immutable but for placements and shapes; safe to trace from many threads.
class RayScene {
 public:
  // One mesh in its own space, as object 0. The mesh must outlive this. Throws InputError as checkMesh does.
  explicit RayScene(const Mesh& mesh);
  // All objects of a scene. The scene's meshes must outlive this. Throws InputError as checkScene does.
  explicit RayScene(const Scene& scene);
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  // Moves the objects to where `scene`, with the same meshes, has them now; rebuilds only what lies above the
  // meshes.
  void place(const Scene& scene);

  // A mesh of the scene, whose triangles join the same vertices as before, has other places and normals now.
  // To be followed by `place`.
  void reshape(uint32_t mesh);

  bool intersect(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray) const;
  // Whether rays from one origin along each of `directions` meet anything: eight at a time, which is faster.
  void occluded(vec3 origin, std::span<const vec3> directions, float nearDistance,
                std::span<uint8_t> isOccluded) const;

  // m: rays that leave a surface start this far along, so that they do not meet it again. Grows with the
  // scene's extent.
  float selfIntersectionDistance() const;

  // Smooth surface that a triangle of a mesh (its index in the scene) belongs to.
  uint32_t patchOf(uint32_t mesh, uint32_t triangle) const;

  // Whether an object's mesh bounds a volume, so that a ray inside must come out again.
  bool isClosed(uint32_t object) const;

  // m3 within an object's mesh; infinite where the mesh is open, as that of water.
  float enclosedVolume(uint32_t object) const;

  // The ray that goes on along `direction` from where `hit` is on the curved surface: its line begins on the
  // flat triangle that was traced.
  Ray leaving(const Hit& hit, vec3 direction) const;
  // The same from no farther than the rim of the triangle, for paths that keep count of what they are inside
  // of: beyond it a ray would begin outside of the mesh, or inside, where it should not.
  Ray leavingTriangle(const Hit& hit, vec3 direction) const;

  // The bare loop every ray rate is held against: nothing but Embree's closest hit, in parallel. Returns how
  // many rays hit.
  std::size_t replay(std::span<const Ray> rays) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl;
};

// Rays traced by this process so far, all scenes together.
uint64_t raysTraced();

}  // namespace nephroid
