// Outgoing rays looked up in light transport tables.
#pragma once

#include <optional>
#include <vector>

#include "transport/source.h"
#include "transport/table/table.h"
#include "transport/traced/traced_source.h"

namespace nephroid {

// Whether light through the object can be tabulated: it is of a clear material with a volume that no other
// object stands in, neither water, whose surface moves, nor faceted like a box or a cut gem.
bool hasTable(const Scene& scene, const Object& object);

// Rays looked up at the vertices of casters that have a table, wherever they stand. A table knows its caster
// alone: what may stand before it, and other casters behind it, are looked for with a ray each, and so is the
// reach where receivers may hide one another. What no table holds (mirrors, reflection, a light inside a
// medium; sight that is totally reflected) is traced.
class TableSource : public TransportSource {
 public:
  // `tables` has one for each object of the scene, or none where the object is to be traced. Scene and
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

  const Scene& scene;
  std::vector<std::optional<TransportTable>> tables;
  std::vector<bool> isRefined;  // of objects
  const TracedSource& traced;
  const bool mayReceiversHide;
};

}  // namespace nephroid
