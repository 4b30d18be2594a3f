// What the pointer is on, and where a thing that it drags goes.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"
#include "trace/ray_scene.h"

namespace nephroid {

// A picture's pixels: x to the right, y down, from the upper left corner.
Ray rayThrough(const Camera& camera, uvec2 size, vec2 pixel);
// None for what is behind the camera.
std::optional<vec2> pixelOf(const Camera& camera, uvec2 size, vec3 point);

enum class Chosen { nothing, object, light };

struct Selection {
  Chosen what = Chosen::nothing;
  uint32_t index = 0;  // in the scene's list
  bool operator==(const Selection&) const = default;
};

enum class HandlePart { body, aim, end };  // all of a light; what a spot is aimed at; the far end of a line

// A place that a light is held by.
struct Handle {
  uint32_t light = 0;
  HandlePart part = HandlePart::body;
  vec3 position{0};  // m
};

// Of all lights. A directional light, which is nowhere, is held on the side it comes from, outside of what is
// lit; a spot's aim is as far along its light as the middle of the scene is away.
std::vector<Handle> handlesOf(const Scene& scene);

// The handle of a light moved to `position`; the light follows.
void moveHandle(Scene& scene, const Handle& handle, vec3 position);

// The nearest handle within `reach` pixels.
std::optional<Handle> handleAt(const Scene& scene, uvec2 size, vec2 pixel, float reach);

// The light whose handle is there, or else the object that is seen there.
Selection pick(const Scene& scene, const RayScene& rays, uvec2 size, vec2 pixel, float reach);

enum class DragAlong { ground, x, y, z };  // a level plane, which is the view's where that is seen edge-on

// Where what was at `anchor` (m) under `from` goes when the pointer goes to `to`.
vec3 draggedTo(const Camera& camera, uvec2 size, vec3 anchor, DragAlong along, vec2 from, vec2 to);

// Turned about `axis` (unit) through `centre`, radians.
void turn(Placement& placement, vec3 centre, vec3 axis, float angle);
void turn(Light& light, vec3 axis, float angle);

// The middle of an object's box, where it stands.
vec3 centreOf(const Scene& scene, const Object& object);

}  // namespace nephroid
