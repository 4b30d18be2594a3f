// Rays as Embree takes them, and its calls, which versions 3 and 4 spell in different ways. For ray_scene.cpp
// alone.
#pragma once

#include "trace/ray_scene.h"

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace nephroid {

#if RTC_VERSION_MAJOR >= 4
inline void embreeIntersect(RTCScene scene, RTCRayHit& query) {
  rtcIntersect1(scene, &query);
}
inline void embreeOccluded(RTCScene scene, RTCRay& ray) {
  rtcOccluded1(scene, &ray);
}
inline void embreeOccluded(RTCScene scene, const int* valid, RTCRay8& rays) {
  rtcOccluded8(valid, scene, &rays);
}
inline void embreeIntersect(RTCScene scene, const int* valid, RTCRayHit8& rays, bool areAlike) {
  RTCIntersectArguments arguments;
  rtcInitIntersectArguments(&arguments);
  if (areAlike) arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &rays, &arguments);
}
#else
inline void embreeIntersect(RTCScene scene, RTCRayHit& query) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene, &context, &query);
}
inline void embreeOccluded(RTCScene scene, RTCRay& ray) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene, &context, &ray);
}
inline void embreeOccluded(RTCScene scene, const int* valid, RTCRay8& rays) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcOccluded8(valid, scene, &context, &rays);
}
inline void embreeIntersect(RTCScene scene, const int* valid, RTCRayHit8& rays, bool areAlike) {
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  if (areAlike) context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
  rtcIntersect8(valid, scene, &context, &rays);
}
#endif

inline RTCRay embreeRay(const Ray& ray) {
  RTCRay query{};
  query.org_x = ray.origin.x;
  query.org_y = ray.origin.y;
  query.org_z = ray.origin.z;
  query.dir_x = ray.direction.x;
  query.dir_y = ray.direction.y;
  query.dir_z = ray.direction.z;
  query.tnear = ray.nearDistance;
  query.tfar = ray.farDistance;
  query.mask = ~0u;
  return query;
}

inline RTCRayHit embreeQuery(const Ray& ray) {
  RTCRayHit query{};
  query.ray = embreeRay(ray);
  query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
  query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  return query;
}

// A ray as one of eight.
template <class Rays>
void setRay(Rays& rays, std::size_t i, const Ray& ray) {
  rays.org_x[i] = ray.origin.x;
  rays.org_y[i] = ray.origin.y;
  rays.org_z[i] = ray.origin.z;
  rays.dir_x[i] = ray.direction.x;
  rays.dir_y[i] = ray.direction.y;
  rays.dir_z[i] = ray.direction.z;
  rays.tnear[i] = ray.nearDistance;
  rays.tfar[i] = ray.farDistance;
  rays.mask[i] = ~0u;
}

}  // namespace nephroid
