// Shaders that are changed while the window is open.
#include "core/error.h"
#include "viewer_loop.h"

namespace nephroid {

void Viewer::reloadShaders() {
#ifdef NEPHROID_SHADER_COMPILER
  if (shaders_.valid()) return;
  shaders_ = std::async(std::launch::async, [] { return gpu::compileAgain(NEPHROID_SHADER_COMPILER); });
  tell(state_, "The shaders are compiled");
#else
  tell(state_, "Only builds with -DNEPHROID_SHADER_RELOAD=ON compile shaders again");
#endif
}

// What does not compile, or does not fit, changes nothing.
void Viewer::useShaders() {
  if (!shaders_.valid() || drawing_ ||
      shaders_.wait_for(std::chrono::seconds(0)) != std::future_status::ready)
    return;
  framesToGo_ = std::max(framesToGo_, 2);
  try {
    gpu::ShaderChanges made = shaders_.get();
    if (!made.error.empty()) return tell(state_, made.error, true);
    gpu::exchange(made);
    try {
      graphics_->remakePrograms();
    } catch (...) {
      gpu::exchange(made);
      throw;
    }
    ++stageCount_;
    tell(state_, std::to_string(made.changes.size()) + " shaders have changed");
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const std::exception& wrong) {
    tell(state_, wrong.what(), true);
  }
}

}  // namespace nephroid
