#pragma once

#include <utility>
#include <vector>

#include "geometry/box.h"
#include "transport/follow.h"
#include "transport/source.h"

namespace nephroid {

// Outgoing rays traced now, for this light, through the whole scene as it stands: the baseline of Iwasaki
// 2005 ("without the table"), the measure of every table, and what deforming casters need. Follows light from
// caster to caster.
class TracedSource : public TransportSource {
 public:
  // Both must outlive this.
  TracedSource(const Scene& scene, const RayScene& rays);

  void vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const override;
  bool refines(const TransportQuery&) const override { return true; }
  OutgoingRay rayAt(const TransportQuery& query, const SurfacePoint& point) const override;

  // The ray at one vertex of the caster's mesh.
  OutgoingRay vertexRay(const TransportQuery& query, uint32_t vertex, uint32_t patch) const;

  // For sources that know the caster alone: whether nothing stands between the emitter and a vertex of the
  // caster's mesh; whether another object may do so; and a ray's way from where it left the caster by
  // whatever it meets next.
  bool isVertexLit(const TransportQuery& query, uint32_t vertex) const;
  bool mayBeShaded(const TransportQuery& query) const;
  void goOn(const TransportQuery& query, OutgoingRay& ray) const;

  // The media around an emitter, for its queries.
  MediumStack mediaAround(const Emitter& emitter) const;

 private:
  bool isLit(const TransportQuery& query, const SurfacePoint& point, vec3 direction) const;

  const Scene& scene;
  Follower follower;
  std::vector<Box> boxes;  // of the meshes, in their own space
};

}  // namespace nephroid
