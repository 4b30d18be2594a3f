// What the mouse does in the picture: it moves the camera, and it chooses, drags and turns objects and
// lights.
#pragma once

#include <optional>

#include "input.h"
#include "trace/ray_scene.h"
#include "viewer/picking.h"
#include "viewer_state.h"

namespace nephroid {

class Pointer {
 public:
  // Handles the input of one frame. `size`: of the picture, in pixels of the window; `input.mouse` is in the
  // same pixels. `rays`: of the scene; null where they are not yet prepared. `isOver`: the pointer is on the
  // picture, and no panel covers it. Returns the object or light that was clicked on, if there was a click.
  std::optional<Selection> use(const Input& input, const RayScene* rays, uvec2 size, bool isOver, float scale,
                               ViewerState& state);

  // Whether a drag is going on.
  bool isHolding() const { return held_ != Held::nothing; }

 private:
  enum class Held { nothing, orbit, look, pan, thing, turn };
  void take(const Input& input, const RayScene* rays, uvec2 size, float reach, ViewerState& state);
  void drag(const Input& input, uvec2 size, ViewerState& state) const;
  void turnThing(const Input& input, ViewerState& state) const;

  Held held_ = Held::nothing;
  MouseButton button_ = MouseButton::left;
  vec2 from_{0};    // pixels, where the drag began
  vec3 anchor_{0};  // m, the point of the scene where the drag began
  std::optional<Handle> handle_;
  Scene before_;  // the lights and objects when the drag began
  bool hasMoved_ = false;
};

}  // namespace nephroid
