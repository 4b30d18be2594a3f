// The interface of transport sources, which compute outgoing rays. Later stages do not depend on which source
// is used.
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
  uint32_t channel = 0;  // color channel, 0..2, whose index of refraction is used
  Paths paths = Paths::transmission;
  uint32_t reflections =
      0;  // bit i: at the i-th boundary where light may be reflected or transmitted, it is reflected
  MediumStack media;  // the objects that the emitter is inside of
  // It is a view ray from the emitter's place, not light. View rays are also computed where something hides
  // the surface, so that they can be interpolated up to the edge of the visible part.
  bool isSight = false;
};

// A point of a caster's surface where light meets it. World space.
struct SurfacePoint {
  vec3 position{0};         // on the curved surface where the mesh has one
  vec3 flatPosition{0};     // on the triangle
  vec3 normal{0};           // unit, smooth
  vec3 geometricNormal{0};  // unit, of the triangle; at a vertex the smooth normal may be used
  uint32_t patch = 0;
};

class TransportSource {
 public:
  virtual ~TransportSource() = default;

  // The outgoing ray for every vertex of the caster's mesh, in the mesh's order.
  virtual void vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const = 0;

  // Whether rays of light are available at any point of the caster's surface, and not only at vertices. View
  // rays always are.
  virtual bool refines(const TransportQuery& query) const = 0;
  virtual OutgoingRay rayAt(const TransportQuery& query, const SurfacePoint& point) const = 0;
};

}  // namespace nephroid
