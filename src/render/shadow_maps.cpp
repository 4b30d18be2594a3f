#include "render/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "scene/emitters.h"

namespace nephroid {
namespace {

struct Sphere {
  vec3 center{0};  // m, world space
  float radius = 0;
};

struct PlacedObject {
  uint32_t index = 0;
  std::array<vec3, 8> corners;  // of its box, in world space
  Sphere sphere;
  bool isFlat = false;
  vec3 normal{0};
  bool isClosed = false;
};

PlacedObject placed(const Scene& scene, const std::vector<MeshExtent>& extents, uint32_t index) {
  const Object& object = scene.objects[index];
  const MeshExtent& extent = extents[object.mesh];
  PlacedObject result;
  result.index = index;
  for (std::size_t i = 0; i < 8; ++i)
    result.corners[i] =
        object.placement.point({(i & 1 ? extent.high : extent.low).x, (i & 2 ? extent.high : extent.low).y,
                                (i & 4 ? extent.high : extent.low).z});
  result.sphere = {object.placement.point(0.5f * (extent.low + extent.high)),
                   extent.radius * object.placement.scale};
  result.isFlat = extent.isFlat;
  result.normal = object.placement.direction(extent.normal);
  result.isClosed = scene.meshes[object.mesh].isClosed;
  return result;
}

// The least of dot(p - origin, axis) over the object, from its box and its sphere: neither holds less than
// all of it.
float nearestAlong(const PlacedObject& object, vec3 origin, vec3 axis) {
  float nearest = std::numeric_limits<float>::infinity();
  for (const vec3 corner : object.corners) nearest = std::min(nearest, dot(corner - origin, axis));
  return std::max(nearest, dot(object.sphere.center - origin, axis) - object.sphere.radius);
}

// A flat object with all others and the light on one side of it (a floor, a wall) shadows nothing.
bool canShadow(const PlacedObject& object, const std::vector<PlacedObject>& all, const Emitter& emitter) {
  if (!object.isFlat) return true;
  const vec3 origin = object.sphere.center;
  const float lightSide = emitter.type == kEmitterDirectional ? -dot(object.normal, emitter.direction)
                                                              : dot(object.normal, emitter.position - origin);
  const vec3 axis = lightSide >= 0 ? object.normal : -object.normal;
  return std::ranges::any_of(all, [&](const PlacedObject& other) {
    return nearestAlong(other, origin, axis) < -1e-4f * (other.sphere.radius + object.sphere.radius);
  });
}

Sphere boundsOf(const std::vector<PlacedObject>& objects) {
  vec3 low(std::numeric_limits<float>::infinity());
  vec3 high = -low;
  for (const PlacedObject& object : objects)
    for (const vec3 corner : object.corners) {
      low = glm::min(low, corner);
      high = glm::max(high, corner);
    }
  Sphere sphere{0.5f * (low + high), 0};
  for (const PlacedObject& object : objects) {
    float farthest = 0;
    for (const vec3 corner : object.corners) farthest = std::max(farthest, distance(corner, sphere.center));
    const float bySphere = distance(object.sphere.center, sphere.center) + object.sphere.radius;
    sphere.radius = std::max(sphere.radius, std::min(farthest, bySphere));
  }
  return sphere;
}

bool reachesInto(const mat4& worldToMap, const Sphere& sphere) {
  const vec4 w = glm::row(worldToMap, 3);
  for (const vec4 side : {glm::row(worldToMap, 0), glm::row(worldToMap, 1)})
    for (const vec4 plane : {w + side, w - side})
      if (dot(vec3(plane), sphere.center) + plane.w < -sphere.radius * length(vec3(plane))) return false;
  return true;
}

mat4 lookAlong(vec3 position, vec3 direction) {
  const vec3 up = std::abs(direction.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  return glm::lookAtRH(position, position + direction, up);
}

// A light's view of `sphere` in a square cone; the depth range holds the sphere as far as it is in front of
// the light.
mat4 coneProjection(vec3 position, vec3 direction, float tangent, const Sphere& sphere) {
  const float away = distance(position, sphere.center);
  const float farthest = away + sphere.radius;
  const float nearest = std::max(away - sphere.radius, 1e-3f * farthest);
  return glm::perspectiveRH_ZO(2 * std::atan(tangent), 1.0f, nearest, farthest * 1.001f) *
         lookAlong(position, direction);
}

class Planner {
 public:
  Planner(const Scene& scene, const std::vector<MeshExtent>& extents, uint32_t resolution)
      : resolution_(resolution) {
    for (uint32_t i = 0; i < scene.objects.size(); ++i)
      if (!scene.meshOf(scene.objects[i]).positions.empty()) objects_.push_back(placed(scene, extents, i));
  }

  void add(const Emitter& emitter, ShadowPlan& plan) {
    ShadowedEmitter lit{};
    lit.emitter = emitter;
    lit.firstMap = static_cast<uint32_t>(plan.maps.size());
    shadowing_.clear();
    for (const PlacedObject& object : objects_)
      if (canShadow(object, objects_, emitter)) shadowing_.push_back(object);
    if (!shadowing_.empty()) {
      sphere_ = boundsOf(shadowing_);
      sphere_.radius *= 1.02f;  // room for the filter
      for (const mat4& projection : projections(lit)) plan.maps.push_back(map(projection, emitter));
    }
    lit.mapCount = static_cast<uint32_t>(plan.maps.size()) - lit.firstMap;
    plan.emitters.push_back(lit);
  }

 private:
  // Also sets the size of the texels.
  std::vector<mat4> projections(ShadowedEmitter& lit) const {
    const Emitter& emitter = lit.emitter;
    const float texels = static_cast<float>(resolution_);
    const float r = sphere_.radius;
    if (emitter.type == kEmitterDirectional) {
      lit.texelSize = 2 * r / texels;
      return {glm::orthoRH_ZO(-r, r, -r, r, 0.0f, 2 * r) *
              lookAlong(sphere_.center - r * emitter.direction, emitter.direction)};
    }
    const vec3 toCenter = sphere_.center - emitter.position;
    const float sine = std::min(r / std::max(length(toCenter), 1e-20f), 1.0f);
    const float cosCone = emitter.type == kEmitterSpot ? -emitter.coneOffset / emitter.coneScale : -1;
    const float cosFit = std::sqrt(1 - sine * sine);
    const float cosine = std::max(cosCone, cosFit);
    if (cosine > 0.5f) {
      const float tangent = std::sqrt(1 - cosine * cosine) / cosine * (1 + 4 / texels);
      lit.texelSizePerDepth = 2 * tangent / texels;
      const vec3 axis = cosCone > cosFit ? emitter.direction : normalize(toCenter);
      return {coneProjection(emitter.position, axis, tangent, sphere_)};
    }
    const float tangent = 1 + 8 / texels;  // the faces overlap by what the filter reaches over
    lit.texelSizePerDepth = 2 * tangent / texels;
    std::vector<mat4> faces;
    for (const vec3 axis :
         {vec3(1, 0, 0), vec3(-1, 0, 0), vec3(0, 1, 0), vec3(0, -1, 0), vec3(0, 0, 1), vec3(0, 0, -1)})
      faces.push_back(coneProjection(emitter.position, axis, tangent, sphere_));
    return faces;
  }

  ShadowMap map(const mat4& worldToMap, const Emitter& emitter) const {
    ShadowMap result;
    result.worldToMap = worldToMap;
    for (const PlacedObject& object : shadowing_) {
      if (!reachesInto(worldToMap, object.sphere)) continue;
      const bool isOutside = emitter.type == kEmitterDirectional ||
                             distance(emitter.position, object.sphere.center) > object.sphere.radius;
      result.casters.push_back({object.index, object.isClosed && isOutside});
    }
    return result;
  }

  uint32_t resolution_;
  std::vector<PlacedObject> objects_;
  std::vector<PlacedObject> shadowing_;  // of the emitter being added
  Sphere sphere_;
};

}  // namespace

MeshExtent extentOf(const Mesh& mesh) {
  MeshExtent extent;
  if (mesh.positions.empty()) return extent;
  extent.low = extent.high = mesh.positions.front();
  for (const vec3 p : mesh.positions) {
    extent.low = glm::min(extent.low, p);
    extent.high = glm::max(extent.high, p);
  }
  const vec3 center = 0.5f * (extent.low + extent.high);
  for (const vec3 p : mesh.positions) extent.radius = std::max(extent.radius, distance(p, center));
  // The largest triangle's normal is that of the plane, if there is one.
  float largest = 0;
  for (const uvec3& t : mesh.triangles) {
    const vec3 across =
        cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
    if (dot(across, across) <= largest) continue;
    largest = dot(across, across);
    extent.normal = normalize(across);
  }
  extent.isFlat = largest > 0 && std::ranges::all_of(mesh.positions, [&](vec3 p) {
                    return std::abs(dot(p - center, extent.normal)) <= 1e-5f * extent.radius;
                  });
  return extent;
}

ShadowPlan planShadowMaps(const Scene& scene, const std::vector<MeshExtent>& extents, uint32_t resolution) {
  ShadowPlan plan;
  Planner planner(scene, extents, resolution);
  for (const Emitter& emitter : emittersOf(scene)) planner.add(emitter, plan);
  return plan;
}

}  // namespace nephroid
