#include "transport/table/table_source.h"

#include <oneapi/tbb/parallel_for.h>

namespace nephroid {

bool hasTable(const Scene& scene, const Object& object) {
  const Material& material = scene.materialOf(object);
  return material.type == MaterialType::dielectric && !material.thinWalled;
}

TableSource::TableSource(const Scene& sceneOfTables, std::vector<std::optional<TransportTable>> tableOfObject,
                         const TracedSource& tracedSource)
    : scene(sceneOfTables), tables(std::move(tableOfObject)), traced(tracedSource) {}

bool TableSource::isTabulated(const TransportQuery& query) const {
  return tables[query.object] && (query.paths == Paths::transmission || query.isSight) &&
         query.media.size == 0;
}

void TableSource::vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  if (!isTabulated(query)) return traced.vertexRays(query, rays);
  const Object& object = scene.objects[query.object];
  tableRays(*tables[query.object], scene.meshOf(object), object.placement, scene.materialOf(object),
            query.emitter, query.channel, rays);
  if (query.isSight) traceLost(query, rays);
}

void TableSource::traceLost(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  oneapi::tbb::parallel_for(std::size_t{0}, rays.size(), [&](std::size_t i) {
    if (rays[i].flags & kRayLost) rays[i] = traced.vertexRay(query, uint32_t(i), 0);
  });
}

OutgoingRay TableSource::rayAt(const TransportQuery& query, const SurfacePoint& point) const {
  return traced.rayAt(query, point);
}

}  // namespace nephroid
