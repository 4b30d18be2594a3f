// What the mouse does in the picture: the camera goes around, things are chosen, dragged and turned.
#pragma once

#include <optional>

#include "input.h"
#include "trace/ray_scene.h"
#include "viewer/picking.h"
#include "viewer_state.h"

namespace nephroid {

class Pointer {
 public:
  // `size` is the picture's, in pixels of the window, and `input.mouse` in them. `rays` are those of the
  // scene; null where there are none yet. `isOver`: the pointer is over the picture, and nothing lies over
  // it. Returns what was clicked on, when it was.
  std::optional<Selection> use(const Input& input, const RayScene* rays, uvec2 size, bool isOver, float scale,
                               ViewerState& state);

  // Something is held: what is done to it is not over.
  bool isHolding() const { return held_ != Held::nothing; }

 private:
  enum class Held { nothing, orbit, look, pan, thing, turn };
  void take(const Input& input, const RayScene* rays, uvec2 size, float reach, ViewerState& state);
  void drag(const Input& input, uvec2 size, ViewerState& state) const;
  void turnThing(const Input& input, ViewerState& state) const;

  Held held_ = Held::nothing;
  MouseButton button_ = MouseButton::left;
  vec2 from_{0};    // pixels, where it was taken
  vec3 anchor_{0};  // m, where that is in the scene
  std::optional<Handle> handle_;
  Scene before_;  // the lights and objects as they were then
  bool hasMoved_ = false;
};

}  // namespace nephroid
