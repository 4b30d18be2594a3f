// Traces rays with Embree, which only ray_scene.cpp calls, by embree_calls.h.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/shared_language.h"
#include "scene/scene.h"
#include "trace/contacts.h"

namespace nephroid {

struct Ray {
  vec3 origin{0};     // m
  vec3 direction{0};  // unit
  float nearDistance = 0;
  float farDistance = std::numeric_limits<float>::infinity();
};

// m along a ray toward a lamp at `distance`, up to where something may stand before it.
inline float beforeLamp(float distance) {
  return distance * (1 - 0x1p-20f);
}

// The surface of another object in the same place as one that a ray hit.
struct Touching {
  uint32_t object = kNone;
  bool isTurned = false;  // it faces the other way
};
inline constexpr std::size_t kMostTouching = 3;

// Of surfaces that lie in the same place, the one that counts: a diffuse one before a mirror, a mirror before
// glass, and then the first of the objects.
struct Hit {
  float distance = 0;       // m
  uint32_t object = kNone;  // index into Scene::objects, or 0 for a scene of one mesh
  uint32_t triangle = 0;
  uint32_t patch = 0;       // number of the smooth surface that the triangle belongs to
  vec2 barycentric{0};      // weights of the triangle's second and third corner
  vec3 position{0};         // on the curved surface where the mesh has one
  vec3 flatPosition{0};     // on the triangle
  vec3 normal{0};           // unit, interpolated from the vertices
  vec3 geometricNormal{0};  // unit, outward by winding
  std::array<Touching, kMostTouching> touching{};
  uint32_t touchingCount = 0;
  std::span<const Touching> touched() const { return {touching.data(), touchingCount}; }
};

// The geometry of a scene for rays. Several threads may trace at the same time, but not during `place` and
// `reshape`.
class RayScene {
 public:
  // One mesh in its own space, as object 0. The mesh must outlive this. Throws InputError as checkMesh does.
  explicit RayScene(const Mesh& mesh);
  // All objects of a scene. The scene's meshes must outlive this. Throws InputError as checkScene does.
  explicit RayScene(const Scene& scene);
  RayScene(RayScene&&) noexcept;
  RayScene& operator=(RayScene&&) noexcept;
  ~RayScene();

  // Takes the placements of `scene`, which must have the same meshes. Rebuilds only the top level of the
  // acceleration structure.
  void place(const Scene& scene);

  // Takes new positions and normals of a mesh of the scene, whose triangles are the same as before. To be
  // followed by `place`.
  void reshape(uint32_t mesh);

  bool intersect(const Ray& ray, Hit& hit) const;
  bool occluded(const Ray& ray) const;
  // Many rays: those near each other should follow one another. What each hits first; `object` is kNone where
  // it hits nothing. Traces in the calling thread. `areAlike`: neighbors have much the same way, as a
  // camera's; faster then, and slower where they do not.
  void intersect(std::span<const Ray> rays, std::span<Hit> hits, bool areAlike = false) const;
  void occluded(std::span<const Ray> rays, std::span<uint8_t> isOccluded) const;
  // Whether rays from one origin along each of `directions` (unit) meet anything. Traces eight rays at a
  // time, which is faster. `isOccluded`: 0 or 1 for each direction.
  void occluded(vec3 origin, std::span<const vec3> directions, float nearDistance,
                std::span<uint8_t> isOccluded) const;

  // The distance (m) across an object's surface that places on it may be off, from the floats that its
  // coordinates and its placement are kept in.
  float rounding(uint32_t object) const;
  // The largest of all objects.
  float largestRounding() const;
  // Of the mesh's triangles, in its own space.
  const Box& box(uint32_t mesh) const;
  // The distance (m) along a ray that leaves an object's surface up to which it may meet this surface again.
  float clearance(uint32_t object, vec3 geometricNormal, vec3 direction) const;

  // What lies where an object's surface is touched by others; intersect has done so for its hits. `hit` has
  // its object, triangle, place and normals, and may become that of another object.
  void addTouching(vec3 direction, Hit& hit) const;
  const Contacts& contacts() const;

  // The ray from a place of a meter, which may lie on a surface, toward a lamp at `distance` m. `cosine`: to
  // the meter's normal.
  Ray fromMeter(vec3 place, vec3 direction, float cosine, float distance) const;

  // The number of the smooth surface of a triangle. `mesh`: index in the scene.
  uint32_t patchOf(uint32_t mesh, uint32_t triangle) const;

  // Whether the object's mesh is closed, so that a ray inside must come out again.
  bool isClosed(uint32_t object) const;

  // The volume (m3) of the object's mesh; infinite where the mesh is open, as for water.
  float enclosedVolume(uint32_t object) const;

  // The ray that leaves the surface at `hit` along `direction` (unit). It goes through the point on the
  // curved surface, but it begins on the flat triangle that was traced.
  Ray leaving(const Hit& hit, vec3 direction) const;
  // The same, but the ray begins within the triangle. For paths that count the objects that they are inside
  // of: beyond the triangle's edge a ray might begin on the wrong side of the mesh.
  Ray leavingTriangle(const Hit& hit, vec3 direction) const;

  // Traces rays with Embree's closest hit and nothing else, in parallel, as a measure for ray rates. Returns
  // the number of rays that hit.
  std::size_t replay(std::span<const Ray> rays) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

// The number of rays that this process has traced, in all scenes.
uint64_t raysTraced();

}  // namespace nephroid
