// Where outgoing rays come from. Nothing after a source knows which one ran.
#pragma once

#include <span>

#include "lights/emitter.h"
#include "scene/scene.h"
#include "trace/media.h"
#include "trace/paths.h"
#include "transport/outgoing_ray.h"

namespace nephroid {

// Light of one emitter, in one band, along one choice of reflections, through one caster.
struct TransportQuery {
  uint32_t object = 0;
  Emitter emitter{};
  uint32_t channel = 0;  // which of the three indices of refraction it is bent by
  Paths paths = Paths::transmission;
  uint32_t reflections = 0;  // bit i: it is reflected at the i-th boundary where it could also be transmitted
  MediumStack media;         // what the emitter stands in
  // A line of sight from the emitter's place rather than light: it is asked for also where something hides
  // the surface, so that rays may be interpolated up to the edge of what is seen.
  bool isSight = false;
};

// A point of a caster's surface where light meets it. World space.
struct SurfacePoint {
  vec3 position{0};      // on the curved surface where the mesh has one
  vec3 flatPosition{0};  // on the triangle
  vec3 normal{0};        // unit, smooth
  vec3 geometricNormal{
      0};  // unit, the triangle's; at a vertex, which is on every surface, the smooth one will do
  uint32_t patch = 0;
};

class TransportSource {
 public:
  virtual ~TransportSource() = default;

  // The outgoing ray for every vertex of the caster's mesh, in the mesh's order.
  virtual void vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const = 0;

  // Whether light's rays can be had anywhere on the caster's surface, and not at the vertices alone. Those of
  // sight always can.
  virtual bool refines(const TransportQuery& query) const = 0;
  virtual OutgoingRay rayAt(const TransportQuery& query, const SurfacePoint& point) const = 0;
};

}  // namespace nephroid
