#include "viewer/picking.h"

#include <algorithm>
#include <cmath>

#include "geometry/bounds.h"
#include "lights/emitters.h"
#include "render/view.h"
#include "scene/framing.h"

namespace nephroid {
namespace {

// What a light is there for.
Sphere sphereOfInterest(const Scene& scene) {
  const Box bounds = boundsOfInterest(scene);
  if (bounds.isEmpty()) return {vec3(0), 1};
  return {bounds.center(), std::max(0.5f * bounds.diagonal(), 1e-3f)};
}

// The place along the line through `anchor` that is nearest to the ray.
vec3 nearestOnAxis(const Ray& ray, vec3 anchor, vec3 axis) {
  const float along = dot(ray.direction, axis);
  const float apart = 1 - along * along;
  if (apart < 1e-4f) return anchor;
  const vec3 offset = ray.origin - anchor;
  return anchor + (dot(axis, offset) - along * dot(ray.direction, offset)) / apart * axis;
}

vec3 onPlane(const Ray& ray, vec3 anchor, vec3 normal) {
  const float facing = dot(ray.direction, normal);
  const float far = 100 * distance(ray.origin, anchor);
  const float t = dot(anchor - ray.origin, normal) / facing;
  return std::isfinite(t) && t > 0 && t < far ? ray.origin + t * ray.direction : anchor;
}

vec3 heldAt(const Camera& camera, uvec2 size, vec3 anchor, DragAlong along, vec2 pixel) {
  constexpr float kEdgeOn = 0.15f;  // sine of the angle between ray and plane
  const Ray ray = rayThrough(camera, size, pixel);
  if (along != DragAlong::ground) {
    vec3 axis(0);
    axis[static_cast<int>(along) - static_cast<int>(DragAlong::x)] = 1;
    return nearestOnAxis(ray, anchor, axis);
  }
  const vec3 view = normalize(camera.target - camera.position);
  const vec3 toAnchor = normalize(anchor - camera.position);
  return onPlane(ray, anchor, std::abs(toAnchor.y) > kEdgeOn ? vec3(0, 1, 0) : -view);
}

}  // namespace

Ray rayThrough(const Camera& camera, uvec2 size, vec2 pixel) {
  const vec3 forward = viewOf(camera, size).forward;
  const vec3 right = normalize(cross(forward, uprightFor(camera, forward)));
  const vec3 up = cross(right, forward);
  const vec2 fromMiddle = (2.0f * pixel - vec2(size)) / static_cast<float>(size.y);
  const float tangent = std::tan(0.5f * glm::radians(camera.verticalFov));
  return {camera.position, normalize(forward + tangent * (fromMiddle.x * right - fromMiddle.y * up))};
}

std::optional<vec2> pixelOf(const Camera& camera, uvec2 size, vec3 point) {
  const View view = viewOf(camera, size);
  const vec4 clip = view.worldToClip * vec4(point, 1);
  if (!(clip.w > view.nearest)) return std::nullopt;
  return (0.5f * vec2(clip) / clip.w + 0.5f) * vec2(size);
}

vec3 centerOf(const Scene& scene, const Object& object) {
  return worldBounds(scene, object).center();
}

std::vector<Handle> handlesOf(const Scene& scene) {
  const Sphere lit = sphereOfInterest(scene);
  std::vector<Handle> handles;
  for (uint32_t i = 0; i < scene.lights.size(); ++i) {
    const Light& light = scene.lights[i];
    const float away = std::max(distance(light.position, lit.center), 1e-3f);
    switch (light.type) {
      case LightType::point:
        handles.push_back({i, HandlePart::body, light.position});
        break;
      case LightType::spot:
        handles.push_back({i, HandlePart::body, light.position});
        handles.push_back({i, HandlePart::aim, light.position + away * light.direction});
        break;
      case LightType::line:
        handles.push_back({i, HandlePart::body, light.position});
        handles.push_back({i, HandlePart::end, light.end});
        break;
      case LightType::area:
        handles.push_back({i, HandlePart::body, middleOf(light)});
        break;
      case LightType::sky:
        break;
      case LightType::directional:
        handles.push_back({i, HandlePart::body, lit.center - 2 * lit.radius * light.direction});
        break;
    }
  }
  return handles;
}

void moveHandle(Scene& scene, const Handle& handle, vec3 position) {
  Light& light = scene.lights[handle.light];
  const auto directionOr = [](vec3 offset, vec3 otherwise) {
    return length(offset) > 1e-6f ? normalize(offset) : otherwise;
  };
  if (light.type == LightType::directional) {
    light.direction = directionOr(sphereOfInterest(scene).center - position, light.direction);
  } else if (handle.part == HandlePart::aim) {
    light.direction = directionOr(position - light.position, light.direction);
  } else if (handle.part == HandlePart::end) {
    if (position != light.position) light.end = position;
  } else {
    const vec3 step = position - (light.type == LightType::area ? middleOf(light) : light.position);
    if (light.type == LightType::line) light.end += step;
    light.position += step;
  }
}

std::optional<Handle> handleAt(const Scene& scene, uvec2 size, vec2 pixel, float reach) {
  std::optional<Handle> nearest;
  for (const Handle& handle : handlesOf(scene)) {
    const std::optional<vec2> at = pixelOf(scene.camera, size, handle.position);
    if (!at || distance(*at, pixel) > reach) continue;
    reach = distance(*at, pixel);
    nearest = handle;
  }
  return nearest;
}

Selection pick(const Scene& scene, const RayScene& rays, uvec2 size, vec2 pixel, float reach) {
  if (const auto handle = handleAt(scene, size, pixel, reach)) return {Chosen::light, handle->light};
  Hit hit;
  if (rays.intersect(rayThrough(scene.camera, size, pixel), hit)) return {Chosen::object, hit.object};
  return {};
}

vec3 draggedTo(const Camera& camera, uvec2 size, vec3 anchor, DragAlong along, vec2 from, vec2 to) {
  return anchor + heldAt(camera, size, anchor, along, to) - heldAt(camera, size, anchor, along, from);
}

void turn(Placement& placement, vec3 center, vec3 axis, float angle) {
  const quat rotation = glm::angleAxis(angle, axis);
  placement.translation = center + rotation * (placement.translation - center);
  placement.rotation = normalize(rotation * placement.rotation);
}

void turn(Light& light, vec3 axis, float angle) {
  const quat rotation = glm::angleAxis(angle, axis);
  if (light.type == LightType::line) {
    const vec3 center = 0.5f * (light.position + light.end);
    light.position = center + rotation * (light.position - center);
    light.end = center + rotation * (light.end - center);
  } else if (light.type == LightType::area) {
    const vec3 center = middleOf(light);
    light.u = rotation * light.u;
    light.v = rotation * light.v;
    light.position = center - 0.5f * (light.u + light.v);
    light.direction = normalize(rotation * light.direction);
  } else if (light.type != LightType::point) {
    light.direction = normalize(rotation * light.direction);
  }
}

}  // namespace nephroid
