#include "transport/traced/traced_source.h"

#include <oneapi/tbb/parallel_for.h>

#include "core/index_range.h"
#include "geometry/bounds.h"
#include "optics/refraction.h"
#include "scene/volume.h"

namespace nephroid {

TracedSource::TracedSource(const Scene& sceneToTrace, const RayScene& rays)
    : scene_(sceneToTrace), follower_(rays, materialsOf(sceneToTrace)) {
  for (const Mesh& mesh : scene_.meshes) boxes_.push_back(boundingBox(mesh));
}

MediumStack TracedSource::mediaAround(const Emitter& emitter) const {
  if (emitter.type == kEmitterDirectional) return {};
  // Most lights stand in no caster's box, and then need no ray.
  for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
    const Object& object = scene_.objects[i];
    Box box = boxes_[object.mesh];
    if (object.water) box.low.y = -std::numeric_limits<float>::infinity();  // its bottom is open
    if (scene_.isCaster(object) && box.holds(object.placement.inversePoint(emitter.position)))
      return follower_.mediaAround(emitter.position);
  }
  return {};
}

bool TracedSource::isLit(const TransportQuery& query, const SurfacePoint& point, vec3 direction) const {
  const float farDistance = query.emitter.type == kEmitterDirectional
                                ? std::numeric_limits<float>::infinity()
                                : glm::length(query.emitter.position - point.position);
  const RayScene& rays = follower_.rayScene();
  const float near = rays.clearance(query.object, point.geometricNormal, direction);
  return !rays.occluded({point.flatPosition, -direction, near, beforeLamp(farDistance)});
}

OutgoingRay TracedSource::rayAt(const TransportQuery& query, const SurfacePoint& point) const {
  const vec3 direction = emitterDirection(query.emitter, point.position);
  const bool arrivesFromOutside = dot(direction, point.geometricNormal) < 0;
  OutgoingRay ray{};
  ray.position = point.position;
  ray.direction = direction;
  ray.flags = kRayLost;
  if (arrivesFromOutside == query.media.contains(query.object)) return ray;
  if (!query.isSight && !isLit(query, point, direction)) {
    ray.flags = kRayOccluded;
    return ray;
  }
  ray = follower_.follow(point, query.object, direction, query.media,
                         {query.channel, query.paths, query.reflections, query.isSight});
  if (query.media.size > 0) {
    // The way from the light to the surface lies inside a medium as well.
    const Material& medium = scene_.materialOf(scene_.objects[query.media.top()]);
    const float distance = length(point.position - query.emitter.position);
    ray.pathLength += distance;
    ray.transmittance *= transmittanceOf(medium, distance);
  }
  return ray;
}

OutgoingRay TracedSource::vertexRay(const TransportQuery& query, uint32_t vertex, uint32_t patch) const {
  const Object& object = scene_.objects[query.object];
  const Mesh& mesh = scene_.meshOf(object);
  const vec3 position = object.placement.point(mesh.positions[vertex]);
  const vec3 normal = object.placement.direction(mesh.normals[vertex]);
  return rayAt(query, {position, position, normal, normal, patch});
}

bool TracedSource::isVertexLit(const TransportQuery& query, uint32_t vertex) const {
  const Object& object = scene_.objects[query.object];
  const vec3 position = object.placement.point(scene_.meshOf(object).positions[vertex]);
  SurfacePoint point;
  point.position = point.flatPosition = position;
  point.geometricNormal = object.placement.direction(scene_.meshOf(object).normals[vertex]);
  return isLit(query, point, emitterDirection(query.emitter, position));
}

// Judged by the boxes: apart along an axis of either, nothing of one is between the emitter and the other.
bool TracedSource::mayBeShaded(const TransportQuery& query) const {
  const Object& caster = scene_.objects[query.object];
  const Box& box = boxes_[caster.mesh];
  const vec3 center = caster.placement.point(box.center());
  const float radius = 0.5f * box.diagonal() * caster.placement.scale;
  for (uint32_t i = 0; i < scene_.objects.size(); ++i) {
    if (i == query.object) continue;
    const Object& other = scene_.objects[i];
    const Box& otherBox = boxes_[other.mesh];
    const vec3 to = other.placement.inversePoint(center);
    const float reach = radius / other.placement.scale;
    const vec3 from = query.emitter.type == kEmitterDirectional
                          ? to - 1e20f * other.placement.inverseDirection(query.emitter.direction)
                          : other.placement.inversePoint(query.emitter.position);
    if (glm::all(glm::greaterThanEqual(glm::max(from, to + reach), otherBox.low)) &&
        glm::all(glm::lessThanEqual(glm::min(from, to - reach), otherBox.high)))
      return true;
  }
  return false;
}

void TracedSource::goOn(const TransportQuery& query, OutgoingRay& ray) const {
  const RayScene& rays = follower_.rayScene();
  Hit hit;
  Ray next{ray.position, ray.direction, rays.rounding(query.object)};
  // What a source rounded may lie inside of the caster that it left.
  do {
    if (!rays.intersect(next, hit)) return;
    next.nearDistance = hit.distance + rays.clearance(hit.object, hit.geometricNormal, ray.direction);
  } while (hit.object == query.object);
  if (!scene_.isCaster(scene_.objects[hit.object])) {
    ray.reach = hit.distance;
    return;
  }
  const OutgoingRay after = follower_.follow(
      {hit.position, hit.flatPosition, hit.normal, hit.geometricNormal, hit.patch}, hit.object, ray.direction,
      query.media, {query.channel, query.paths, query.reflections, query.isSight});
  ray.position = after.position;
  ray.direction = after.direction;
  ray.pathLength += after.pathLength;
  ray.transmittance *= after.transmittance;
  ray.flags |= after.flags;
  ray.signature = ray.signature * 16777619u ^ after.signature;
  ray.reach = after.reach;
}

void TracedSource::vertexRays(const TransportQuery& query, std::span<OutgoingRay> rays) const {
  const Object& object = scene_.objects[query.object];
  const Mesh& mesh = scene_.meshOf(object);
  std::vector<uint32_t> patches(mesh.positions.size(), 0);
  for (uint32_t t = 0; t < mesh.triangles.size(); ++t)
    for (int corner = 0; corner < 3; ++corner)
      patches[mesh.triangles[t][corner]] = follower_.rayScene().patchOf(object.mesh, t);
  oneapi::tbb::parallel_for(IndexRange(0, mesh.positions.size(), 64), [&](const IndexRange& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i)
      rays[i] = vertexRay(query, uint32_t(i), patches[i]);
  });
}

}  // namespace nephroid
