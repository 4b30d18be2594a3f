// Time in the viewer: it stands, goes on, and is stepped.
#include <algorithm>

#include "panels.h"
#include "viewer/scene_time.h"
#include "viewer_loop.h"

namespace nephroid {

void Viewer::setTime(double seconds) {
  if (!state_.isOpen || state_.scene.time == seconds) return;
  try {
    keepHistory();
    moveTo(state_.scene, state_.firstState, text_, std::max(seconds, 0.0));
    state_.history.replace(stateOf(state_.scene));
  } catch (const std::exception& wrong) {
    state_.isPlaying = false;
    return tell(state_, wrong.what(), true);
  }
  framesToGo_ = std::max(framesToGo_, 1);
}

// Into water that moves by a grid of its own: what it does then is simulated from here on.
void Viewer::dropStone() {
  if (!state_.isOpen || !graphics_->stage) return;
  const Area area = pictureArea(state_, vec2(window_.framebufferSize()), graphics_->gui().scale());
  Hit hit;
  const Ray ray = rayThrough(state_.scene.camera, glm::max(uvec2(area.size), uvec2(1)), mouse_);
  if (!graphics_->stage->rayScene().intersect(ray, hit)) return;
  Object& object = state_.scene.objects[hit.object];
  if (!object.water || object.water->grid.x == 0)
    return tell(state_, "There is no water for a stone to fall into there");
  const vec3 place = object.placement.inversePoint(hit.position);
  const float across = std::min(object.water->size.x, object.water->size.y);
  if (!object.water->simulation) object.water->simulation.emplace();
  object.water->simulation->drops.push_back(
      {static_cast<float>(state_.scene.time), {place.x, place.z}, 0.025f * across, 0.01f * across});
  state_.isPlaying = true;
}

void Viewer::play(double seconds) {
  constexpr double kLongestStep = 0.25;  // s, where pictures take longer than that
  if (state_.isPlaying) setTime(state_.scene.time + std::min(seconds, kLongestStep));
}

}  // namespace nephroid
