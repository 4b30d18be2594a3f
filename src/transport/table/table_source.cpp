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
    : scene_(sceneOfTables),
      tables_(std::move(tableOfObject)),
      traced_(tracedSource),
      mayReceiversHide_(mayHide(sceneOfTables)) {
  for (std::size_t i = 0; i < tables_.size(); ++i) {
    const Object& object = scene_.objects[i];
    const bool isMirror = scene_.materialOf(object).type == MaterialType::mirror;
    isRefined_.push_back(!tables_[i] && (!isMirror || scene_.meshOf(object).hasEdges()));
  }
}

// The rays at a mirror's vertices represent its light well, as those of a table do.
bool TableSource::refines(const TransportQuery& query) const {
  return isRefined_[query.object];
}

bool TableSource::isTabulated(const TransportQuery& query) const {
  return tables_[query.object] && (query.paths == Paths::transmission || query.isSight) &&
         query.reflections == 0 && query.media.size == 0;
}

void TableSource::vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  if (!isTabulated(query)) return traced_.vertexRays(query, rays);
  const Object& object = scene_.objects[query.object];
  tableRays(*tables_[query.object], scene_.meshOf(object), object.placement, scene_.materialOf(object),
            query.emitter, query.channel, rays);
  if (query.isSight)
    completeSight(query, rays);
  else
    meetScene(query, rays);
}

void TableSource::meetScene(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  const bool mayBeShaded = traced_.mayBeShaded(query);
  bool mayGoOn = mayReceiversHide_;
  for (uint32_t i = 0; i < scene_.objects.size(); ++i)
    mayGoOn |= i != query.object && scene_.isCaster(scene_.objects[i]);
  if (!mayBeShaded && !mayGoOn) return;
  oneapi::tbb::parallel_for(IndexRange(0, rays.size(), 64), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      if (rays[i].flags != 0) continue;
      if (mayBeShaded && !traced_.isVertexLit(query, uint32_t(i)))
        rays[i].flags |= kRayOccluded;
      else if (mayGoOn)
        traced_.goOn(query, rays[i]);
    }
  });
}

// Sight is followed where light is lost, and to what it meets.
void TableSource::completeSight(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  oneapi::tbb::parallel_for(IndexRange(0, rays.size(), 64), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      if (rays[i].flags == kRayLost)
        rays[i] = traced_.vertexRay(query, uint32_t(i), 0);
      else if (rays[i].flags == 0)
        traced_.goOn(query, rays[i]);
  });
}

OutgoingRay TableSource::rayAt(const TransportQuery& query, const SurfacePoint& point) const {
  return traced_.rayAt(query, point);
}

}  // namespace nephroid
