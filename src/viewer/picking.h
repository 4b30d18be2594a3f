// Finds what is under the pointer, and moves what the pointer drags.
#pragma once

#include <optional>
#include <vector>

#include "scene/scene.h"
#include "trace/ray_scene.h"

namespace nephroid {

// The ray of a pixel. Pixels: x to the right, y down, from the upper left corner. `size`: of the picture.
Ray rayThrough(const Camera& camera, uvec2 size, vec2 pixel);
// The pixel of a point (m). None where the point is behind the camera.
std::optional<vec2> pixelOf(const Camera& camera, uvec2 size, vec3 point);

enum class Chosen { nothing, object, light };

struct Selection {
  Chosen what = Chosen::nothing;
  uint32_t index = 0;  // in the scene's list
  bool operator==(const Selection&) const = default;
};

enum class HandlePart {
  body,
  aim,
  end
};  // body: the light itself; aim: the point that a spot is aimed at; end: the second end of a line

// A point by which a light can be dragged.
struct Handle {
  uint32_t light = 0;
  HandlePart part = HandlePart::body;
  vec3 position{0};  // m
};

// The handles of all lights. The handle of a directional light is outside of the lit objects, on the side
// from which the light comes. The distance from a spot to its aim is the distance to the middle of the scene.
std::vector<Handle> handlesOf(const Scene& scene);

// Moves a handle to `position` (m), and the light with it.
void moveHandle(Scene& scene, const Handle& handle, vec3 position);

// The nearest handle within `reach` pixels.
std::optional<Handle> handleAt(const Scene& scene, uvec2 size, vec2 pixel, float reach);

// The light with a handle at the pixel, or else the object that is visible there.
Selection pick(const Scene& scene, const RayScene& rays, uvec2 size, vec2 pixel, float reach);

enum class DragAlong {
  ground,
  x,
  y,
  z
};  // ground: a horizontal plane, or the plane of the picture where the horizontal plane is seen edge-on

// The new position of the point `anchor` (m), when the pointer moves from the pixel `from` to `to`.
vec3 draggedTo(const Camera& camera, uvec2 size, vec3 anchor, DragAlong along, vec2 from, vec2 to);

// Rotates about `axis` (unit) through `center` (m). `angle`: radians.
void turn(Placement& placement, vec3 center, vec3 axis, float angle);
void turn(Light& light, vec3 axis, float angle);

// The middle (m, world space) of an object's box.
vec3 centerOf(const Scene& scene, const Object& object);

}  // namespace nephroid
