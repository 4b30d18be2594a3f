// The transport source that traces rays now, without a table.
#pragma once

#include <utility>
#include <vector>

#include "geometry/box.h"
#include "transport/follow.h"
#include "transport/source.h"

namespace nephroid {

// The source "traced": traces outgoing rays through the whole present scene, from caster to caster. Iwasaki
// 2005 compares with it ("without the table"); tables are tested against it, and casters that change their
// shape need it.
class TracedSource : public TransportSource {
 public:
  // Both must outlive this.
  TracedSource(const Scene& scene, const RayScene& rays);

  void vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const override;
  bool refines(const TransportQuery&) const override { return true; }
  OutgoingRay rayAt(const TransportQuery& query, const SurfacePoint& point) const override;

  // The ray at one vertex of the caster's mesh.
  OutgoingRay vertexRay(const TransportQuery& query, uint32_t vertex, uint32_t patch) const;

  // For sources that know only the caster. isVertexLit: whether nothing stands between the emitter and a
  // vertex. mayBeShaded: whether another object may stand between. goOn: follows a ray that has left the
  // caster through the other objects.
  bool isVertexLit(const TransportQuery& query, uint32_t vertex) const;
  bool mayBeShaded(const TransportQuery& query) const;
  void goOn(const TransportQuery& query, OutgoingRay& ray) const;

  // The media around an emitter, for its queries.
  MediumStack mediaAround(const Emitter& emitter) const;

 private:
  bool isLit(const TransportQuery& query, const SurfacePoint& point, vec3 direction) const;

  const Scene& scene_;
  Follower follower_;
  std::vector<Box> boxes_;  // of the meshes, in their own space
};

}  // namespace nephroid
