// Frames. They are drawn beside the window, which waits for one only as long as nobody minds.
#include <algorithm>

#include "core/error.h"
#include "viewer_loop.h"

namespace nephroid {

Viewer::Drawing::~Drawing() {
  if (!work.valid()) return;  // done, and what it made was taken
  prepared->progress.cancel();
  work.wait();
}

// With the exposure that was metered, where the camera has none.
Scene Viewer::exposed(Scene scene) const {
  if (!scene.camera.exposure) scene.camera.exposure = state_.metered;
  return scene;
}

Viewer::Drawn Viewer::wantedOf(const Scene& scene, const PictureSettings& drawnWith, uint32_t stage) const {
  return {stateOf(scene),
          scene.time,
          pictureSize(),
          drawnWith.technique.transport.paths,
          state_.settings.samples.count,
          stage,
          scene.camera.exposure ? std::nullopt : state_.metered};
}

// A new stage, and its first frame.
void Viewer::beginStage(std::unique_ptr<Prepared> prepared) {
  if (opensScene_) state_.metered.reset();
  const Scene& scene = opensScene_ ? prepared->scene : state_.scene;
  const Drawn wanted = wantedOf(scene, prepared->settings, stageCount_ + 1);
  const bool keepsLight = options_.frames == 0;
  drawing_ = std::make_unique<Drawing>(wanted, std::move(prepared), true);
  drawing_->work = std::async(std::launch::async, [&device = graphics_->device(), keepsLight,
                                                   scene = exposed(scene), &drawing = *drawing_] {
    drawing.made = std::make_unique<Stage>(device, drawing.prepared, drawing.of.size, keepsLight);
    drawing.passes = drawing.made->render(scene);
  });
}

// The next frame of the present stage, where something has changed.
void Viewer::beginFrame() {
  if (!graphics_->stage || !state_.isOpen) return;
  Stage& stage = *graphics_->stage;
  const Drawn wanted = wantedOf(state_.scene, stage.settings(), stageCount_);
  if ((wanted == drawn_ && options_.frames == 0) || wanted == canceled_) return;
  canceled_.reset();
  if (drawn_.stage == stageCount_ && isPictureWhole()) writeWantedPictures();
  if (wanted.size != stage.size()) {
    stage.resize(wanted.size);
    picture_ = {&stage.picture(), false};
  }
  stage.prepared()->progress.renew();
  drawing_ = std::make_unique<Drawing>(wanted, stage.prepared(), false);
  drawing_->work =
      std::async(std::launch::async, [&stage, scene = exposed(state_.scene), &drawing = *drawing_] {
        drawing.passes = stage.render(scene);
      });
}

bool Viewer::isStageBusy() const {
  return drawing_ && !drawing_->isOfNewStage;
}

// Whether there is a new picture.
bool Viewer::drawPicture() {
  if (!drawing_) beginFrame();
  if (!drawing_) return false;
  constexpr double kPatience = 0.15;  // s
  if (endsByItself(options_) || options_.waitsForFrames)
    drawing_->work.wait();
  else if (drawing_->work.wait_for(std::chrono::duration<double>(drawing_->isLate ? 0 : kPatience)) !=
           std::future_status::ready) {
    drawing_->isLate = true;
    return false;
  }
  return takeDrawing();
}

bool Viewer::takeDrawing() {
  const std::unique_ptr<Drawing> done = std::move(drawing_);
  framesToGo_ = std::max(framesToGo_, 1);
  try {
    done->work.get();
  } catch (const Interrupted&) {
    if (done->isOfNewStage) {
      keepStage();
    } else {
      tell(state_, "Canceled: the picture stays as it was");
      canceled_ = done->of;
      drawn_.samples = 0;
    }
    return false;
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const std::exception& wrong) {
    if (!done->isOfNewStage) throw;
    failToPrepare(wrong.what());
    return false;
  }
  if (done->made) adopt(*done);
  const Stage& stage = *graphics_->stage;
  state_.times.add(millisecondsSince(done->start), done->passes);
  state_.stats = stage.stats();
  state_.outputs = graphics_->stage->renderer().outputs();
  state_.memoryBytes = graphics_->device().memoryBytes();
  state_.gathered = 0;
  drawn_ = done->of;
  const bool isMetered = !drawn_.state.camera.exposure;
  const bool isAskedAnew = drawn_.metered && !state_.metered;  // while this frame was drawn
  if (!isMetered)
    state_.metered.reset();
  else if (!isAskedAnew)
    state_.metered = stage.exposure();
  drawn_.metered = isMetered ? std::optional(stage.exposure()) : std::nullopt;
  lastChange_ = Clock::now();
  return true;
}

void Viewer::adopt(Drawing& done) {
  graphics_->stage = std::move(done.made);
  ++stageCount_;
  prepareMilliseconds_ = preparedMilliseconds_;
  if (!std::exchange(opensScene_, false)) return;
  const Camera before = state_.scene.camera;
  Scene scene = graphics_->stage->scene();
  const bool keepsCamera = std::exchange(keepsCamera_, false) && scene.camera == state_.firstState.camera;
  state_.scene = std::move(scene);
  state_.file = opening_;
  text_ = openingText_;
  state_.isOpen = true;
  state_.selection = {};
  state_.firstState = stateOf(state_.scene);
  state_.history = History(state_.firstState);
  if (keepsCamera) state_.scene.camera = before;
}

// What was wanted in its place was canceled.
void Viewer::keepStage() {
  tell(state_, "Canceled: the picture stays as it was");
  if (std::exchange(opensScene_, false) || !graphics_->stage) return;
  state_.settings = graphics_->stage->settings();
  state_.scene.materials = graphics_->stage->scene().materials;
}

void Viewer::failToPrepare(const std::string& why) {
  tell(state_, why, true);
  if (!std::exchange(opensScene_, false)) failed_ = {stateOf(state_.scene), state_.settings};
}

// What goes on beside the window, and whether the user has had enough of it.
void Viewer::watchDrawing() {
  if (!drawing_) return;
  if (std::exchange(state_.isPreparationCanceled, false)) drawing_->prepared->progress.cancel();
  state_.preparing = drawing_->prepared->progress.state();
  if (!drawing_->isOfNewStage || drawing_->prepared->progress.isCanceled()) state_.preparing->fraction = 0;
  state_.preparing->name = drawing_->prepared->progress.isCanceled() ? "Ending" : "Drawing";
}

// Whether the picture is at rest, and has not all samples yet. While a pass's output is shown it keeps to the
// pixels' middles.
bool Viewer::isGathering() const {
  const bool isAtRest =
      graphics_->stage && state_.isOpen && !drawing_ && drawn_.stage == stageCount_ && options_.frames == 0;
  return isAtRest && drawn_.samples > 1 && state_.shown != Shown::output &&
         graphics_->stage->gathered() < drawn_.samples;
}

// One sample in each step, so that what a hand does next waits for no more than that.
void Viewer::gatherPicture() {
  graphics_->stage->gather(drawn_.samples);
  state_.gathered = graphics_->stage->gathered();
  framesToGo_ = std::max(framesToGo_, 1);
}

}  // namespace nephroid
