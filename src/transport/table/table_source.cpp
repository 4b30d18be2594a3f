#include "transport/table/table_source.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

#include "core/index_range.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

bool isFlat(const Mesh& mesh) {
  return std::ranges::all_of(mesh.normals,
                             [&](vec3 normal) { return dot(normal, mesh.normals[0]) > 1 - 1e-6f; });
}

// One another, or a part of themselves.
bool mayHide(const Scene& scene) {
  uint32_t receivers = 0;
  for (const Object& object : scene.objects) {
    if (scene.isCaster(object)) continue;
    if (++receivers > 1 || !isFlat(scene.meshOf(object))) return true;
  }
  return false;
}

bool holdsAnother(const Scene& scene, const Object& object) {
  const Box bounds = worldBounds(scene, object);
  return std::ranges::any_of(scene.objects, [&](const Object& other) {
    return &other != &object && bounds.holdsInside(worldBounds(scene, other));
  });
}

}  // namespace

bool hasTable(const Scene& scene, const Object& object) {
  const Material& material = scene.materialOf(object);
  return material.type == MaterialType::dielectric && !material.thinWalled && !object.water &&
         !scene.meshOf(object).hasEdges() && !holdsAnother(scene, object);
}

TableSource::TableSource(const Scene& sceneOfTables, std::vector<std::optional<TransportTable>> tableOfObject,
                         const TracedSource& tracedSource)
    : scene(sceneOfTables),
      tables(std::move(tableOfObject)),
      traced(tracedSource),
      mayReceiversHide(mayHide(sceneOfTables)) {
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const Object& object = scene.objects[i];
    const bool isMirror = scene.materialOf(object).type == MaterialType::mirror;
    isRefined.push_back(!tables[i] && (!isMirror || scene.meshOf(object).hasEdges()));
  }
}

// A mirror's vertices tell most of what it does, as a table's do.
bool TableSource::refines(const TransportQuery& query) const {
  return isRefined[query.object];
}

bool TableSource::isTabulated(const TransportQuery& query) const {
  return tables[query.object] && (query.paths == Paths::transmission || query.isSight) &&
         query.reflections == 0 && query.media.size == 0;
}

void TableSource::vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  if (!isTabulated(query)) return traced.vertexRays(query, rays);
  const Object& object = scene.objects[query.object];
  tableRays(*tables[query.object], scene.meshOf(object), object.placement, scene.materialOf(object),
            query.emitter, query.channel, rays);
  if (query.isSight)
    completeSight(query, rays);
  else
    meetScene(query, rays);
}

void TableSource::meetScene(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  const bool mayBeShaded = traced.mayBeShaded(query);
  bool mayGoOn = mayReceiversHide;
  for (uint32_t i = 0; i < scene.objects.size(); ++i)
    mayGoOn |= i != query.object && scene.isCaster(scene.objects[i]);
  if (!mayBeShaded && !mayGoOn) return;
  oneapi::tbb::parallel_for(IndexRange(0, rays.size(), 64), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (rays[i].flags != 0) continue;
      if (mayBeShaded && !traced.isVertexLit(query, uint32_t(i)))
        rays[i].flags |= kRayOccluded;
      else if (mayGoOn)
        traced.goOn(query, rays[i]);
    }
  });
}

// Sight is followed where light is lost, and to what it meets.
void TableSource::completeSight(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  oneapi::tbb::parallel_for(IndexRange(0, rays.size(), 64), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      if (rays[i].flags == kRayLost)
        rays[i] = traced.vertexRay(query, uint32_t(i), 0);
      else if (rays[i].flags == 0)
        traced.goOn(query, rays[i]);
  });
}

OutgoingRay TableSource::rayAt(const TransportQuery& query, const SurfacePoint& point) const {
  return traced.rayAt(query, point);
}

}  // namespace nephroid
