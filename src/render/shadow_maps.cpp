#include "render/shadow_maps.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_access.hpp>

#include "core/directions.h"
#include "geometry/bounds.h"
#include "lights/emitters.h"
#include "lights/lamp_light.h"

namespace nephroid {
namespace {

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
  result.corners = placedCorners(extent.box, object.placement);
  result.sphere = {object.placement.point(extent.box.center()), extent.radius * object.placement.scale};
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

// A flat object with all others and the light on one side of it (a floor, a wall) shadows no other. `extent`:
// of the light, m about its middle, or the sine of half the angle that it is seen under. `sunk`: how far
// another may be on the other side, of its size.
bool canShadow(const PlacedObject& object, const std::vector<PlacedObject>& all, const Emitter& emitter,
               float extent, float sunk) {
  if (!object.isFlat) return true;
  const vec3 origin = object.sphere.center;
  const float lightSide = emitter.type == kEmitterDirectional ? -dot(object.normal, emitter.direction)
                                                              : dot(object.normal, emitter.position - origin);
  if (std::abs(lightSide) < extent) return true;
  const vec3 axis = lightSide >= 0 ? object.normal : -object.normal;
  return std::ranges::any_of(all, [&](const PlacedObject& other) {
    return nearestAlong(other, origin, axis) < -sunk * (other.sphere.radius + object.sphere.radius);
  });
}

Sphere boundsOf(const std::vector<PlacedObject>& objects) {
  Box box;
  for (const PlacedObject& object : objects)
    for (const vec3 corner : object.corners) box.include(corner);
  Sphere sphere{box.center(), 0};
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

constexpr float kFewestTexels = 64;      // along a side, so that a map's border is empty
constexpr float kWidestTangent = 1.75f;  // of the half angle that one map may see: about 60 degrees

void setAxes(ShadowProjection& projection, vec3 forward) {
  const vec3 up = std::abs(forward.y) < 0.9f ? vec3(0, 1, 0) : vec3(1, 0, 0);
  projection.forward = forward;
  projection.right = normalize(cross(forward, up));
  projection.up = cross(projection.right, forward);
}

// The tangent of what a map along unit `forward` must see on either side of the sphere's middle, infinite
// where the sphere is not wholly ahead.
float tangentOf(const Sphere& sphere, vec3 position, vec3 forward) {
  const vec3 toCenter = sphere.center - position;
  const float depth = dot(toCenter, forward);
  if (depth <= sphere.radius) return std::numeric_limits<float>::infinity();
  // In the plane of the axis and the sphere's middle it is the farthest.
  const float aside = std::sqrt(std::max(dot(toCenter, toCenter) - depth * depth, 0.0f));
  const float sine = sphere.radius / length(toCenter);
  const float angle = std::atan2(aside, depth) + std::asin(std::min(sine, 1.0f));
  if (angle >= glm::radians(89.0f)) return std::numeric_limits<float>::infinity();
  return std::tan(angle) - aside / depth;
}

mat4 perspectiveMap(const ShadowProjection& projection, vec3 position) {
  const vec3 toAim = projection.aim - position;
  const vec2 middle =
      vec2(dot(projection.right, toAim), dot(projection.up, toAim)) / dot(projection.forward, toAim);
  const float depthScale = projection.farthest / (projection.farthest - projection.nearest);
  const std::array<vec3, 4> rows{(projection.right - middle.x * projection.forward) / projection.halfWidth,
                                 (projection.up - middle.y * projection.forward) / projection.halfWidth,
                                 depthScale * projection.forward, projection.forward};
  mat4 map(0);
  for (int i = 0; i < 4; ++i) map = glm::row(map, i, vec4(rows[i], -dot(rows[i], position)));
  map[3].z -= depthScale * projection.nearest;
  return map;
}

mat4 parallelMap(const ShadowProjection& projection) {
  const float width = projection.halfWidth, depth = projection.farthest - projection.nearest;
  const std::array<vec3, 3> rows{projection.right / width, projection.up / width, projection.forward / depth};
  mat4 map(1);
  for (int i = 0; i < 3; ++i) map = glm::row(map, i, vec4(rows[i], -dot(rows[i], projection.aim)));
  map[3].z -= projection.nearest / depth;
  return map;
}

// Of one of the maps of one of a light's points.
mat4 worldToMap(const ShadowedLight& lit, const Emitter& emitter, uint32_t face) {
  if (emitter.type == kEmitterDirectional) return parallelMap(lit.projection);
  if (lit.mapCount == 1) return perspectiveMap(lit.projection, emitter.position);
  constexpr std::array<vec3, 6> kAxes{vec3(1, 0, 0),  vec3(-1, 0, 0), vec3(0, 1, 0),
                                      vec3(0, -1, 0), vec3(0, 0, 1),  vec3(0, 0, -1)};
  ShadowProjection projection = lit.projection;
  setAxes(projection, kAxes[face]);
  projection.aim = emitter.position + projection.forward;
  return perspectiveMap(projection, emitter.position);
}

class Planner {
 public:
  Planner(const Scene& scene, const std::vector<MeshExtent>& extents, uint32_t resolution)
      : resolution_(resolution), hasAir_(scene.medium.has_value()) {
    for (uint32_t i = 0; i < scene.objects.size(); ++i)
      if (!scene.meshOf(scene.objects[i]).positions.empty()) objects_.push_back(placed(scene, extents, i));
  }

  // `together`: emitters of the whole light.
  ShadowedLight plan(const EmitterRow& row, uint32_t together) {
    std::vector<Emitter> points(row.count, row.first);
    for (uint32_t i = 0; i < row.count; ++i) points[i].position += float(i) * row.step;
    ShadowedLight lit;
    lit.row = row;
    lit.resolution = static_cast<uint32_t>(
        std::max(kFewestTexels, std::round(float(resolution_) / std::sqrt(float(together)))));
    shadowing_.clear();
    for (const PlacedObject& object : objects_)
      if (hasAir_ || std::ranges::any_of(points, [&](const Emitter& emitter) {
            return canShadow(object, objects_, emitter, 0, 1e-4f);
          }))
        shadowing_.push_back(object);
    if (shadowing_.empty()) return lit;
    sphere_ = boundsOf(shadowing_);
    sphere_.radius *= 1.02f;  // room for the filter
    project(points, lit);
    for (const Emitter& emitter : points)
      for (uint32_t face = 0; face < lit.mapCount; ++face)
        lit.maps.push_back(map(worldToMap(lit, emitter, face), emitter));
    return lit;
  }

 private:
  void project(const std::vector<Emitter>& points, ShadowedLight& lit) const {
    ShadowProjection& projection = lit.projection;
    const float border = 1 + 4 / float(lit.resolution);
    if (lit.row.first.type == kEmitterDirectional) {
      lit.mapCount = 1;
      setAxes(projection, lit.row.first.direction);
      projection.aim = sphere_.center;
      projection.halfWidth = sphere_.radius * border;
      projection.nearest = -sphere_.radius;
      projection.farthest = sphere_.radius;
      return;
    }
    const vec3 middle = 0.5f * (points.front().position + points.back().position);
    const vec3 toCenter = sphere_.center - middle;
    vec3 forward = length(toCenter) > 0 ? normalize(toCenter) : vec3(0, 0, -1);
    float tangent = 0;
    for (const Emitter& emitter : points)
      tangent = std::max(tangent, tangentOf(sphere_, emitter.position, forward));
    projection.aim = sphere_.center;
    const float cosCone =
        lit.row.first.type == kEmitterSpot ? -lit.row.first.coneOffset / lit.row.first.coneScale : -1;
    const float tanCone = std::sqrt(std::max(1 - cosCone * cosCone, 0.0f)) / cosCone;
    if (cosCone > 0 && tanCone < tangent) {
      forward = lit.row.first.direction;
      tangent = tanCone;
      projection.aim = lit.row.first.position + sphere_.radius * forward;
    }
    lit.mapCount = tangent < kWidestTangent ? 1 : 6;
    setAxes(projection, forward);
    // The faces of a cube overlap by what the filter reaches over.
    projection.halfWidth = lit.mapCount == 1 ? tangent * border : 2 * border - 1;
    setDepths(points, lit);
  }

  // Such that they hold the sphere as far as it is in front of each point.
  void setDepths(const std::vector<Emitter>& points, ShadowedLight& lit) const {
    ShadowProjection& projection = lit.projection;
    projection.nearest = std::numeric_limits<float>::infinity();
    projection.farthest = 0;
    for (const Emitter& emitter : points) {
      const vec3 toCenter = sphere_.center - emitter.position;
      const float away = length(toCenter);
      // What is seen in the corner of a cube's face is sqrt(3) times as far as it is deep.
      const float nearest = lit.mapCount == 1 ? dot(toCenter, projection.forward) - sphere_.radius
                                              : (away - sphere_.radius) / std::sqrt(3.0f);
      projection.nearest = std::min(projection.nearest, nearest);
      projection.farthest = std::max(projection.farthest, 1.001f * (away + sphere_.radius));
    }
    projection.nearest = std::max(projection.nearest, 1e-3f * projection.farthest);
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
  bool hasAir_;  // which is shaded behind floors and walls too
  std::vector<PlacedObject> objects_;
  std::vector<PlacedObject> shadowing_;  // of the light being planned
  Sphere sphere_;
};

}  // namespace

MeshExtent extentOf(const Mesh& mesh) {
  MeshExtent extent;
  extent.box = boundingBox(mesh);
  extent.radius = boundingSphere(mesh).radius;
  const vec3 center = extent.box.center();
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

std::vector<ShadowedLight> planShadowMaps(const Scene& scene, const std::vector<MeshExtent>& extents,
                                          uint32_t resolution) {
  Planner planner(scene, extents, resolution);
  std::vector<ShadowedLight> lights;
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    const std::vector<EmitterRow> rows = emitterRowsOf(scene.lights[i], i);
    uint32_t together = 0;
    for (const EmitterRow& row : rows) together += row.count;
    for (const EmitterRow& row : rows) lights.push_back(planner.plan(row, together));
  }
  return lights;
}

std::vector<Box> boxesThatShadow(const Scene& scene, const std::vector<MeshExtent>& extents,
                                 const Light& light) {
  std::vector<PlacedObject> objects;
  for (uint32_t i = 0; i < scene.objects.size(); ++i)
    if (!scene.meshOf(scene.objects[i]).positions.empty()) objects.push_back(placed(scene, extents, i));
  Emitter lamp = lampOf(light);
  lamp.position = middleOf(light);
  const float extent =
      light.type == LightType::directional ? std::sin(glm::radians(0.5f * light.angle)) : extentOf(light);
  std::vector<Box> boxes;
  for (const PlacedObject& object : objects) {
    if (!canShadow(object, objects, lamp, extent, 1e-6f)) continue;
    Box box;
    for (const vec3 corner : object.corners) box.include(corner);
    boxes.push_back(box);
  }
  return boxes;
}

}  // namespace nephroid
