#include "viewer_loop.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <new>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/image_io.h"
#include "core/interrupt.h"
#include "dialogs.h"
#include "panels.h"
#include "shown_views.h"
#include "viewer/camera_control.h"

namespace nephroid {
namespace {

constexpr int kFramesToSettle = 3;  // that panels take to answer what was done to them
constexpr double kIdleWait = 0.5;   // s
constexpr double kBusyWait = 0.03;  // s, while something goes on beside the window

// Samples are gathered after a picture was drawn.
bool areDrawnAlike(PictureSettings a, const PictureSettings& b) {
  a.samples = b.samples;
  return a == b;
}

// A run that is measured does not depend on how a window was left.
ViewerPreferences preferencesFor(const ViewerOptions& options) {
  ViewerPreferences preferences;
  if (!endsByItself(options)) preferences = loadPreferences(preferencesFile());
  if (options.size.x > 0) {
    preferences.arePanelsShown = true;
    preferences.windowSize = options.size + uvec2(uint32_t(kPanelWidth), 0);
  }
  if (!options.picture.empty()) preferences.arePanelsShown = preferences.areTimesShown = false;
  return preferences;
}

}  // namespace

Viewer::Viewer(const ViewerOptions& options) : Viewer(options, preferencesFor(options)) {}

Viewer::Viewer(const ViewerOptions& options, const ViewerPreferences& preferences)
    : options_(options),
      window_("nephroid", preferences.windowSize),
      graphics_(std::make_unique<Graphics>(window_, options)),
      framesToGo_(kFramesToSettle) {
  state_.arePanelsShown = preferences.arePanelsShown;
  if (options.size.x > 0)
    window_.resizeFramebuffer(options.size + uvec2(state_.arePanelsShown ? uint32_t(panelWidth()) : 0, 0));
  state_.settings = options.settings;
  for (const std::string& view : options.shown) showView(viewNamed(view), state_);
  state_.areTimesShown = preferences.areTimesShown;
  state_.device = graphics_->device().info().name;
}

float Viewer::panelWidth() const {
  return kPanelWidth * graphics_->gui().scale();
}

void Viewer::keepPreferences() const {
  ViewerPreferences preferences;
  if (endsByItself(options_)) return;
  // A size that was asked for once is not how the user likes windows.
  preferences.windowSize =
      options_.size.x > 0 ? loadPreferences(preferencesFile()).windowSize : window_.size();
  preferences.arePanelsShown = state_.arePanelsShown;
  preferences.areTimesShown = state_.areTimesShown;
  savePreferences(preferencesFile(), preferences);
}

void Viewer::prepare(std::function<Scene()> load) {
  preparation_ = std::make_unique<Preparation>(std::move(load), state_.settings);
  preparationStart_ = Clock::now();
}

// The scene as it is shown, with other settings or other materials than what draws it was made for.
void Viewer::prepareWhatIsWanted() {
  if (preparation_ || (drawing_ && drawing_->isOfNewStage) || !state_.isOpen) return;
  const SceneState wanted = stateOf(state_.scene);
  if (failed_ && isSameScene(failed_->first, wanted) && failed_->second == state_.settings) return;
  failed_.reset();
  const Stage* stage = graphics_->stage.get();
  if (stage && areDrawnAlike(stage->settings(), state_.settings) &&
      !needsPreparation(stateOf(stage->scene()), wanted, state_.settings.technique))
    return;
  opensScene_ = false;
  prepare([scene = state_.scene] { return scene; });
}

void Viewer::takePrepared() {
  state_.preparing.reset();
  if (!preparation_ || drawing_) return watchDrawing();
  if (std::exchange(state_.isPreparationCanceled, false)) preparation_->cancel();
  if (!preparation_->isDone()) {
    state_.preparing = preparation_->progress();
    return;
  }
  const std::unique_ptr<Preparation> done = std::move(preparation_);
  framesToGo_ = kFramesToSettle;
  preparedMilliseconds_ = millisecondsSince(preparationStart_);
  try {
    beginStage(done->take());
  } catch (const gpu::DeviceLost&) {
    throw;
  } catch (const Interrupted&) {
    keepStage();
  } catch (const std::exception& wrong) {
    failToPrepare(wrong.what());
  }
}

double Viewer::waitSeconds() const {
  if (endsByItself(options_) || framesToGo_ > 0 || state_.isPlaying || isGathering()) return 0;
  const bool isBusy =
      preparation_ || drawing_ || referenceWorker_.isRunning() || !tasks_.empty() || shaders_.valid();
  return isBusy ? kBusyWait : kIdleWait;
}

// A step is a part of the way to what is looked at, so that it suits any scene.
void Viewer::moveByKeys(double seconds) {
  const auto held = [&](int key) { return window_.isHeld(key) ? 1.0f : 0.0f; };
  const vec3 way{held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_PAGE_UP) - held(GLFW_KEY_PAGE_DOWN),
                 held(GLFW_KEY_W) - held(GLFW_KEY_S)};
  const vec2 around{held(GLFW_KEY_RIGHT) - held(GLFW_KEY_LEFT), held(GLFW_KEY_UP) - held(GLFW_KEY_DOWN)};
  // A key that went down with Ctrl does not fly when Ctrl is let go first.
  if (way == vec3(0)) isFlightHeld_ = false;
  if (isFlightHeld_ || (way == vec3(0) && around == vec2(0))) return;
  Camera& camera = state_.scene.camera;
  const auto step = static_cast<float>(std::min(seconds, 0.1));
  fly(camera, step * 0.7f * distance(camera.position, camera.target) * way);
  if (around != vec2(0)) orbit(camera, step * around);
  framesToGo_ = kFramesToSettle;
  lastCameraStep_ = Clock::now();
}

void Viewer::usePointer(const Input& input) {
  const float scale = graphics_->gui().scale();
  const Area area = pictureArea(state_, vec2(window_.framebufferSize()), scale);
  Input inPicture = input;
  inPicture.mouse -= area.corner;
  inPicture.takenAt -= area.corner;
  mouse_ = inPicture.mouse;
  const RayScene* rays = graphics_->stage && !isStageBusy() ? &graphics_->stage->rayScene() : nullptr;
  const bool isOver = !graphics_->gui().wantsMouse() && inPicture.mouse.x >= 0;
  if (isOver && input.wheel != 0) lastCameraStep_ = Clock::now();
  if (std::ranges::count(input.wentDown, true) > 0) keepHistory();
  const auto clicked =
      pointer_.use(inPicture, rays, glm::max(uvec2(area.size), uvec2(1)), isOver, scale, state_);
  if (!clicked) return;
  const bool isWater = clicked->what == Chosen::object && takesStones(state_.scene.objects[clicked->index]);
  if (isWater)
    dropStone();
  else
    state_.selection = *clicked;
}

void Viewer::receive(const Input& input) {
  const double seconds = millisecondsSince(lastFrame_) * 1e-3;
  lastFrame_ = Clock::now();
  if (input.isAny || pointer_.isHolding()) framesToGo_ = kFramesToSettle;
  for (const std::filesystem::path& file : input.dropped) drop(file);
  if (window_.isClosing()) close();
  const bool isTyping = graphics_->gui().wantsKeyboard();
  for (const KeyPress& key : input.presses) {
    if (state_.question && key.key == GLFW_KEY_ESCAPE) state_.question->answer = Question::Answer::cancel;
    if (!isTyping && !state_.question) press(key);
    isFlightHeld_ |= key.isControl;
  }
  state_.isReferenceHeld = !isTyping && window_.isHeld(GLFW_KEY_SPACE);
  if (!state_.isOpen || state_.question) return;
  if (!isTyping && !input.isControl) moveByKeys(seconds);
  play(seconds);
  usePointer(input);
}

// What was done is one step when all is let go.
void Viewer::keepHistory() {
  if (state_.isOpen && !pointer_.isHolding() && !ImGui::IsAnyItemActive())
    state_.history.add(stateOf(state_.scene));
}

// What the wheel and held keys do one after another is one step too.
void Viewer::keepHistoryAtRest() {
  constexpr double kRest = 0.4;  // s
  if (millisecondsSince(lastCameraStep_) > 1000 * kRest) keepHistory();
}

void Viewer::undo() {
  if (!state_.isOpen || pointer_.isHolding()) return;
  keepHistory();
  apply(state_.history.undo(), state_.scene);
}

void Viewer::redo() {
  if (!state_.isOpen || pointer_.isHolding()) return;
  keepHistory();
  apply(state_.history.redo(), state_.scene);
}

uvec2 Viewer::pictureSize() const {
  const Area area = pictureArea(state_, vec2(window_.framebufferSize()), graphics_->gui().scale());
  return glm::max(uvec2(area.size) / state_.divisor, uvec2(16));
}

void Viewer::layOut() {
  const ImGuiIO& io = ImGui::GetIO();
  const vec2 windowSize(io.DisplaySize.x, io.DisplaySize.y);
  const float scale = graphics_->gui().scale();
  const Area area = pictureArea(state_, windowSize, scale);
  auto seconds = static_cast<float>(state_.scene.time);
  drawPanels(state_, windowSize, scale, seconds);
  if (seconds != static_cast<float>(state_.scene.time)) setTime(double(seconds));
  drawDialogs(state_, keyBindings(), windowSize, scale);
  if (!graphics_->stage) return;
  const vec2 end = area.corner + area.size;
  ImGui::GetBackgroundDrawList()->AddImage(picture_.id(), {area.corner.x, area.corner.y}, {end.x, end.y});
  drawLines(area.corner, area.size);
  drawHandles(area.corner, area.size);
}

void Viewer::showTitle() {
  if (!state_.isOpen || !graphics_->stage) return;
  window_.setTitle(state_.file.filename().string() + (isSaved() ? "" : "*") + " - " +
                   graphics_->stage->settings().technique.technique + " - nephroid");
}

void Viewer::showFrame() {
  const uvec2 framebuffer = window_.framebufferSize();
  if (framebuffer.x == 0 || framebuffer.y == 0) return;  // minimized
  const Clock::time_point start = Clock::now();
  graphics_->gui().begin();
  layOut();
  keepHistoryAtRest();
  showTitle();
  const bool isNew = drawPicture();
  if (!isNew && isGathering()) gatherPicture();
  if (!isGathering() && !isStageBusy() && isPictureWhole()) writeWantedPictures();
  refineReference();
  chooseShownImage();
  updateLines();
  graphics_->show(framebuffer);
  if (drawn_.stage != 0) ++shownFrames_;
  if (!isNew) return;
  addToVideo();
  const double milliseconds = millisecondsSince(start);
  if (options_.frames > 0) frameMilliseconds_.push_back(milliseconds);
  state_.framesPerSecond = 1000 / std::max(milliseconds, 1e-3);
}

// The device was lost, or there was not enough memory: all on it is made anew. The scene as it was changed is
// the host's, and stays.
void Viewer::recover(const std::string& why, bool isLost) {
  constexpr double kRareLoss = 10;  // s between two of them
  drawing_.reset();
  graphics_.reset();
  drawn_ = {};
  uploaded_.reset();
  linesOf_.reset();
  state_.outputs.clear();
  try {
    graphics_ = std::make_unique<Graphics>(window_, options_);
  } catch (const std::exception& none) {
    throw RuntimeFailure(why + "; " + none.what() + rescued());
  }
  const bool isRare = millisecondsSince(std::exchange(lastLoss_, Clock::now())) > 1000 * kRareLoss;
  if (isLost && isRare) {
    tell(state_, why + ". All on it was made anew; nothing of the scene is lost", true);
    if (opensScene_ && !preparation_) prepareOpening();
    return;
  }
  // What failed is not tried again until something is changed.
  if (state_.isOpen) failed_ = {stateOf(state_.scene), state_.settings};
  tell(state_, why, true);
}

void Viewer::writeStatsOfFrames() const {
  if (options_.stats.empty()) return;
  Stats stats = state_.stats;
  stats.device = state_.device;
  describeSettings(state_.settings, stats);
  stats.prepareMilliseconds = prepareMilliseconds_;
  stats.frameMilliseconds = median(frameMilliseconds_);
  stats.passes = state_.times.passes();
  stats.memoryBytes = graphics_->device().memoryBytes();
  stats.exposure = double(graphics_->stage->exposure());
  setCount(stats, "frames", frameMilliseconds_.size());
  setCount(stats, "width", drawn_.size.x);
  setCount(stats, "height", drawn_.size.y);
  setCount(stats, "window_width", window_.framebufferSize().x);
  setCount(stats, "validation_messages", graphics_->device().validationMessages().size());
  writeFileAtomically(options_.stats, statsJson(stats));
}

// Throws InputError where something that was asked for is not there to be shown.
void Viewer::writeShown() {
  if (options_.picture.empty()) return;
  for (const std::string& name : options_.shown) {
    const NamedView view = viewNamed(name);
    if (view.overlay ? lines_.empty() : !outputOf(state_, view.pass, view.output))
      throw InputError("--show " + name + ": there is nothing of this kind with " +
                       state_.settings.technique.technique + " here");
  }
  writePng(options_.picture, graphics_->screenPicture());
}

bool Viewer::isDone() const {
  const bool isSettled = options_.picture.empty() || (shownFrames_ > kFramesToSettle && !isGathering());
  return endsByItself(options_) && frameMilliseconds_.size() >= options_.frames && isSettled;
}

bool Viewer::step() {
  throwIfInterrupted();
  framesToGo_ = std::max(framesToGo_ - 1, 0);
  try {
    receive(window_.poll(waitSeconds()));
    answerQuestion();
    if (window_.isClosing()) return false;
    watchFile();
    finishTasks();
    useShaders();
    takePrepared();
    prepareWhatIsWanted();
    showFrame();
  } catch (const gpu::DeviceLost& lost) {
    recover(lost.what(), true);
  } catch (const RuntimeFailure& failure) {
    recover(failure.what(), false);
  } catch (const std::bad_alloc&) {
    recover("There was not enough memory for this; try fewer vertices, directions or texels", false);
  }
  if (endsByItself(options_) && !graphics_->stage && !preparation_ && !drawing_)
    throw InputError(state_.message.text);
  return !isDone();
}

void Viewer::run() {
  if (!options_.scene.empty()) openNow(options_.scene);
  while (step()) continue;
  writeShown();
  keepPreferences();
  writeStatsOfFrames();
}

void runViewer(const ViewerOptions& options) {
  Viewer(options).run();
}

}  // namespace nephroid
