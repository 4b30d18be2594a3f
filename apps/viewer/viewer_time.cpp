// Time in the viewer: it stands, goes on, and is stepped.
#include <algorithm>

#include "panels.h"
#include "viewer/scene_time.h"
#include "viewer_loop.h"

namespace nephroid {

void Viewer::setTime(double seconds) {
  if (!state_.isOpen || state_.scene.time == seconds) return;
  try {
    moveTo(state_.scene, state_.firstState, state_.history, text_, std::max(seconds, 0.0), waves_);
  } catch (const std::exception& wrong) {
    state_.isPlaying = false;
    return tell(state_, wrong.what(), true);
  }
  framesToGo_ = std::max(framesToGo_, 1);
}

// Into water that moves on a grid of its own: what it does then is simulated from here on.
void Viewer::dropStone() {
  if (!state_.isOpen || !graphics_->stage || isStageBusy()) return;
  const Area area = pictureArea(state_, vec2(window_.framebufferSize()), graphics_->gui().scale());
  Hit hit;
  const Ray ray = rayThrough(state_.scene.camera, glm::max(uvec2(area.size), uvec2(1)), mouse_);
  if (!graphics_->stage->rayScene().intersect(ray, hit)) return;
  const Object& object = state_.scene.objects[hit.object];
  if (!takesStones(object))
    return tell(state_, object.water ? "No stone falls into this water: its surface is read from files"
                                     : "There is no water for a stone to fall into there");
  const vec3 place = object.placement.inversePoint(hit.position);
  nephroid::dropStone(state_.scene, hit.object, {place.x, place.z});
  state_.isPlaying = true;
}

void Viewer::play(double seconds) {
  constexpr double kLongestStep = 0.25;  // s, where pictures take longer than that
  if (state_.isPlaying) setTime(state_.scene.time + std::min(seconds, kLongestStep));
}

}  // namespace nephroid
