// Outgoing rays looked up in light transport tables.
#pragma once

#include <optional>
#include <vector>

#include "transport/source.h"
#include "transport/table/table.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

// Whether the object can have a light transport table. Its material must be clear glass with a volume, and no
// other object may be inside. It must not be water, whose surface moves, and not faceted like a box or a cut
// gem.
bool hasTable(const Scene& scene, const Object& object);

// The source "table": looks up the rays at the vertices of casters that have a table. A table contains only
// its caster. So other objects before the caster, and other casters behind it, are found with one ray each,
// and so is the reach, where receivers may hide one another. Everything that no table contains is traced:
// mirrors, reflection, a light inside a medium, and view rays that are totally reflected.
class TableSource : public TransportSource {
 public:
  // `tables`: one element for each object of the scene; an empty one where the object is traced. Scene and
  // `traced` must outlive this.
  TableSource(const Scene& scene, std::vector<std::optional<TransportTable>> tables,
              const TracedSource& traced);

  void vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const override;
  bool refines(const TransportQuery& query) const override;
  OutgoingRay rayAt(const TransportQuery& query, const SurfacePoint& point) const override;

 private:
  bool isTabulated(const TransportQuery& query) const;
  void meetScene(const TransportQuery& query, std::span<OutgoingRay> rays) const;
  void completeSight(const TransportQuery& query, std::span<OutgoingRay> rays) const;

  const Scene& scene_;
  std::vector<std::optional<TransportTable>> tables_;
  std::vector<bool> isRefined_;  // of objects
  const TracedSource& traced_;
  const bool mayReceiversHide_;
};

}  // namespace nephroid
