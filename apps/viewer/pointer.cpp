#include "pointer.h"

#include "viewer/camera_control.h"

namespace nephroid {
namespace {

constexpr float kRadiansPerPixel = 0.006f;
constexpr float kClickReach = 3;    // pixels that a click may be off where it began
constexpr float kHandleReach = 14;  // pixels

// While x, y or z is held; Shift: up and down.
DragAlong dragAlong(const Input& input) {
  if (input.isShift) return DragAlong::y;
  return input.heldAxis < 0 ? DragAlong::ground
                            : static_cast<DragAlong>(static_cast<int>(DragAlong::x) + input.heldAxis);
}

}  // namespace

std::optional<Selection> Pointer::use(const Input& input, const RayScene* rays, uvec2 size, bool isOver,
                                      float scale, ViewerState& state) {
  Camera& camera = state.scene.camera;
  if (isOver && input.wheel != 0) zoom(camera, input.wheel);
  if (held_ == Held::nothing && isOver) take(input, rays, size, scale * kHandleReach, state);
  hasMoved_ |= held_ != Held::nothing && distance(input.mouse, from_) > scale * kClickReach;
  const vec2 angle = kRadiansPerPixel / scale * input.moved;
  switch (held_) {
    case Held::orbit:
      if (hasMoved_) orbit(camera, {-angle.x, angle.y});
      break;
    case Held::look:
      look(camera, {angle.x, -angle.y});
      break;
    case Held::pan:
      pan(camera, input.moved, static_cast<float>(size.y));
      break;
    case Held::thing:
      if (hasMoved_) drag(input, size, state);
      break;
    case Held::turn:
      turnThing(input, state);
      break;
    case Held::nothing:
      break;
  }
  if (held_ == Held::nothing || input.isDown[static_cast<int>(button_)]) return std::nullopt;
  held_ = Held::nothing;
  const bool isClick = !hasMoved_ && button_ == MouseButton::left && rays;
  if (!isClick) return std::nullopt;
  return pick(state.scene, *rays, size, input.mouse, scale * kHandleReach);
}

void Pointer::take(const Input& input, const RayScene* rays, uvec2 size, float reach, ViewerState& state) {
  from_ = input.takenAt;
  hasMoved_ = false;
  handle_.reset();
  const auto hold = [&](MouseButton button, Held what) {
    button_ = button;
    held_ = what;
  };
  if (input.wentDown[static_cast<int>(MouseButton::right)]) return hold(MouseButton::right, Held::look);
  if (input.wentDown[static_cast<int>(MouseButton::middle)]) return hold(MouseButton::middle, Held::pan);
  if (!input.wentDown[static_cast<int>(MouseButton::left)]) return;

  hold(MouseButton::left, input.isShift ? Held::pan : Held::orbit);
  handle_ = handleAt(state.scene, size, input.takenAt, reach);
  Hit hit;
  const bool isObject = !handle_ && rays && state.selection.what == Chosen::object &&
                        rays->intersect(rayThrough(state.scene.camera, size, input.takenAt), hit) &&
                        hit.object == state.selection.index;
  if (!handle_ && !isObject) return;
  if (handle_) state.selection = {Chosen::light, handle_->light};
  anchor_ = handle_ ? handle_->position : hit.position;
  before_.objects = state.scene.objects;
  before_.lights = state.scene.lights;
  held_ = input.isControl ? Held::turn : Held::thing;
}

// From where it was taken, not from frame to frame: it comes back with the pointer.
void Pointer::drag(const Input& input, uvec2 size, ViewerState& state) const {
  Scene& scene = state.scene;
  const vec3 to = draggedTo(scene.camera, size, anchor_, dragAlong(input), from_, input.mouse);
  if (handle_) {
    scene.lights[handle_->light] = before_.lights[handle_->light];
    moveHandle(scene, *handle_, to);
  } else {
    const uint32_t index = state.selection.index;
    scene.objects[index].placement.translation = before_.objects[index].placement.translation + to - anchor_;
  }
}

// About +Y by moving sideways, and about the view's right by moving up and down; about one axis alone while
// its key is held.
void Pointer::turnThing(const Input& input, ViewerState& state) const {
  Scene& scene = state.scene;
  const auto turnSelected = [&](vec3 axis, float angle) {
    if (handle_) return turn(scene.lights[handle_->light], axis, angle);
    Object& object = scene.objects[state.selection.index];
    turn(object.placement, centerOf(scene, object), axis, angle);
  };
  const vec2 angle = kRadiansPerPixel * input.moved;
  if (input.heldAxis >= 0) {
    vec3 axis(0);
    axis[input.heldAxis] = 1;
    return turnSelected(axis, angle.x + angle.y);
  }
  const vec3 right = normalize(cross(scene.camera.target - scene.camera.position, scene.camera.up));
  turnSelected({0, 1, 0}, angle.x);
  turnSelected(right, angle.y);
}

}  // namespace nephroid
