#include "viewer.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <chrono>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/interrupt.h"
#include "graphics.h"
#include "panels.h"
#include "pointer.h"
#include "scene/load.h"
#include "techniques/registry.h"
#include "viewer/camera_control.h"

namespace nephroid {
namespace {

using Clock = std::chrono::steady_clock;

constexpr uvec2 kFirstWindow{1280, 720};  // units
constexpr int kFramesToSettle = 3;        // that panels take to answer what was done to them
constexpr double kIdleWait = 0.5;         // s
constexpr double kBusyWait = 0.03;        // s, while something is prepared

double millisecondsSince(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

uvec2 windowSizeFor(const ViewerOptions& options) {
  if (options.size.x == 0) return kFirstWindow;
  return options.size + uvec2(options.arePanelsShown ? uint32_t(kPanelWidth) : 0u, 0u);
}

// What the picture on the screen was made of.
struct Drawn {
  SceneState state;
  Camera camera;
  uvec2 size{0};
  const Stage* stage = nullptr;
  bool operator==(const Drawn&) const = default;
};

class Viewer {
 public:
  explicit Viewer(const ViewerOptions& options);
  void run();

 private:
  void open(const std::filesystem::path& file);
  void prepare(std::function<Scene()> load);
  void prepareWhatIsWanted();
  void takePrepared();
  void adopt(std::unique_ptr<Prepared> prepared);
  double waitSeconds() const;
  void receive(const Input& input);
  void press(const KeyPress& key);
  void moveByKeys(double seconds);
  void usePointer(const Input& input);
  void keepHistory();
  uvec2 pictureSize() const;
  bool drawPicture();  // whether there was anything new to draw
  void layOut();
  void showFrame();
  void writeStatsOfFrames() const;

  const ViewerOptions options_;
  DesktopWindow window_;
  std::unique_ptr<Graphics> graphics_;
  ViewerState state_;
  Pointer pointer_;
  std::unique_ptr<Preparation> preparation_;
  bool opensScene_ = false;  // what is prepared is another scene, not this one with other settings
  std::filesystem::path opening_;
  std::optional<std::pair<SceneState, TechniqueSettings>> failed_;  // what could not be prepared
  SceneState preparedFor_;
  GuiImage picture_;
  Drawn drawn_;
  int framesToGo_ = kFramesToSettle;  // until the window is at rest
  Clock::time_point lastFrame_ = Clock::now();
  std::vector<double> frameMilliseconds_;
  double prepareMilliseconds_ = 0;
  Clock::time_point preparationStart_;
};

Viewer::Viewer(const ViewerOptions& options)
    : options_(options),
      window_("nephroid", windowSizeFor(options)),
      graphics_(std::make_unique<Graphics>(window_, options)) {
  state_.settings = options.technique;
  state_.arePanelsShown = options.arePanelsShown;
  state_.areTimesShown = options.arePanelsShown;
  state_.device = graphics_->device().info().name;
}

void Viewer::open(const std::filesystem::path& file) {
  opensScene_ = true;
  opening_ = file;
  prepare([file, time = options_.time] { return loadScene(file, time); });
}

void Viewer::prepare(std::function<Scene()> load) {
  preparation_ = std::make_unique<Preparation>(std::move(load), state_.settings);
  preparationStart_ = Clock::now();
}

// The scene as it is shown, with other settings or other materials than what draws it was made for.
void Viewer::prepareWhatIsWanted() {
  if (preparation_ || !state_.isOpen) return;
  const SceneState wanted = stateOf(state_.scene);
  if (failed_ && failed_->first == wanted && failed_->second == state_.settings) return;
  failed_.reset();
  const Stage* stage = graphics_->stage.get();
  if (stage && stage->settings() == state_.settings &&
      !needsPreparation(preparedFor_, wanted, state_.settings))
    return;
  opensScene_ = false;
  preparedFor_ = wanted;
  prepare([scene = state_.scene] { return scene; });
}

void Viewer::takePrepared() {
  state_.preparing.reset();
  if (!preparation_) return;
  if (std::exchange(state_.isPreparationCancelled, false)) preparation_->cancel();
  if (!preparation_->isDone()) {
    state_.preparing = preparation_->progress();
    return;
  }
  const std::unique_ptr<Preparation> done = std::move(preparation_);
  framesToGo_ = kFramesToSettle;
  try {
    adopt(done->take());
  } catch (const Interrupted&) {
    tell(state_, "Cancelled: the picture goes on as it was");
    if (!opensScene_ && graphics_->stage) {
      state_.settings = graphics_->stage->settings();
      apply(state_.history.undo(), state_.scene);
    }
  } catch (const std::exception& wrong) {
    tell(state_, wrong.what(), true);
    if (!opensScene_) failed_ = {stateOf(state_.scene), state_.settings};
  }
}

void Viewer::adopt(std::unique_ptr<Prepared> prepared) {
  Scene scene = prepared->scene;
  graphics_->stage.reset();
  graphics_->stage = std::make_unique<Stage>(graphics_->device(), std::move(prepared), pictureSize());
  prepareMilliseconds_ = millisecondsSince(preparationStart_);
  if (!opensScene_) return;
  state_.scene = std::move(scene);
  state_.file = opening_;
  state_.isOpen = true;
  state_.selection = {};
  state_.firstState = preparedFor_ = stateOf(state_.scene);
  state_.history = History(state_.firstState);
  window_.setTitle(state_.file.filename().string() + " - nephroid");
}

double Viewer::waitSeconds() const {
  if (options_.frames > 0 || framesToGo_ > 0) return 0;
  return preparation_ ? kBusyWait : kIdleWait;
}

void Viewer::press(const KeyPress& key) {
  const auto next = [&] {
    const auto all = techniques();
    const auto now = std::ranges::find(all, state_.settings.technique, &TechniqueEntry::name);
    const auto index = static_cast<std::size_t>(now - all.begin());
    state_.settings.technique = all[(index + (key.isShift ? all.size() - 1 : 1)) % all.size()].name;
  };
  if (key.isControl) {
    if (key.key == GLFW_KEY_Z && !key.isShift) apply(state_.history.undo(), state_.scene);
    if (key.key == GLFW_KEY_Y || (key.key == GLFW_KEY_Z && key.isShift))
      apply(state_.history.redo(), state_.scene);
    if (key.key == GLFW_KEY_Q) window_.setClosing(true);
    return;
  }
  switch (key.key) {
    case GLFW_KEY_TAB:
      state_.arePanelsShown = !state_.arePanelsShown;
      break;
    case GLFW_KEY_T:
      state_.areTimesShown = !state_.areTimesShown;
      break;
    case GLFW_KEY_M:
      next();
      break;
    case GLFW_KEY_B:
      state_.settings.source = state_.settings.source == Source::table ? Source::traced : Source::table;
      break;
    case GLFW_KEY_ESCAPE:
      state_.selection = {};
      break;
    default:
      break;
  }
}

// A step is a part of the way to what is looked at, so that it suits any scene.
void Viewer::moveByKeys(double seconds) {
  const auto held = [&](int key) { return window_.isHeld(key) ? 1.0f : 0.0f; };
  const vec3 way{held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_PAGE_UP) - held(GLFW_KEY_PAGE_DOWN),
                 held(GLFW_KEY_W) - held(GLFW_KEY_S)};
  const vec2 around{held(GLFW_KEY_RIGHT) - held(GLFW_KEY_LEFT), held(GLFW_KEY_UP) - held(GLFW_KEY_DOWN)};
  if (way == vec3(0) && around == vec2(0)) return;
  Camera& camera = state_.scene.camera;
  const auto step = static_cast<float>(std::min(seconds, 0.1));
  fly(camera, step * 0.7f * distance(camera.position, camera.target) * way);
  if (around != vec2(0)) orbit(camera, step * around);
  framesToGo_ = kFramesToSettle;
}

void Viewer::usePointer(const Input& input) {
  const float scale = graphics_->gui().scale();
  const Area area = pictureArea(state_, vec2(window_.framebufferSize()), scale);
  Input inPicture = input;
  inPicture.mouse -= area.corner;
  const RayScene* rays = graphics_->stage ? &graphics_->stage->rayScene() : nullptr;
  const bool isOver = !graphics_->gui().wantsMouse() && inPicture.mouse.x >= 0;
  pointer_.use(inPicture, rays, glm::max(uvec2(area.size), uvec2(1)), isOver, scale, state_);
}

void Viewer::receive(const Input& input) {
  const double seconds = millisecondsSince(lastFrame_) * 1e-3;
  lastFrame_ = Clock::now();
  if (input.isAny || pointer_.isHolding()) framesToGo_ = kFramesToSettle;
  for (const std::filesystem::path& file : input.dropped) open(file);
  if (!state_.isOpen) return;
  if (!graphics_->gui().wantsKeyboard()) {
    for (const KeyPress& key : input.presses) press(key);
    if (!input.isControl) moveByKeys(seconds);
  }
  usePointer(input);
}

// What was done is one step when all is let go.
void Viewer::keepHistory() {
  if (state_.isOpen && !pointer_.isHolding() && !ImGui::IsAnyItemActive())
    state_.history.add(stateOf(state_.scene));
}

uvec2 Viewer::pictureSize() const {
  const Area area = pictureArea(state_, vec2(window_.framebufferSize()), graphics_->gui().scale());
  return glm::max(uvec2(area.size) / state_.divisor, uvec2(16));
}

bool Viewer::drawPicture() {
  if (!graphics_->stage || !state_.isOpen) return false;
  Stage& stage = *graphics_->stage;
  const Drawn wanted{stateOf(state_.scene), state_.scene.camera, pictureSize(), &stage};
  if (wanted == drawn_ && options_.frames == 0) return false;
  if (wanted.size != stage.size()) stage.resize(wanted.size);
  const Clock::time_point start = Clock::now();
  const std::vector<PassTime> passes = stage.render(state_.scene);
  state_.times.add(millisecondsSince(start), passes);
  state_.stats = stage.stats();
  state_.memoryBytes = graphics_->device().memoryBytes();
  drawn_ = wanted;
  return true;
}

void Viewer::layOut() {
  const ImGuiIO& io = ImGui::GetIO();
  const vec2 windowSize(io.DisplaySize.x, io.DisplaySize.y);
  const float scale = graphics_->gui().scale();
  const Area area = pictureArea(state_, windowSize, scale);
  drawPanels(state_, windowSize, scale);
  if (!graphics_->stage) return;
  picture_ = {&graphics_->stage->renderer().images().picture, false};
  const vec2 end = area.corner + area.size;
  ImGui::GetBackgroundDrawList()->AddImage(picture_.id(), {area.corner.x, area.corner.y}, {end.x, end.y});
}

void Viewer::showFrame() {
  const uvec2 framebuffer = window_.framebufferSize();
  if (framebuffer.x == 0 || framebuffer.y == 0) return;  // minimised
  const Clock::time_point start = Clock::now();
  graphics_->gui().begin();
  layOut();
  keepHistory();
  const bool isNew = drawPicture();
  graphics_->show(framebuffer);
  if (!isNew) return;
  const double milliseconds = millisecondsSince(start);
  if (options_.frames > 0) frameMilliseconds_.push_back(milliseconds);
  state_.shownPerSecond = 1000 / std::max(milliseconds, 1e-3);
}

void Viewer::writeStatsOfFrames() const {
  if (options_.stats.empty()) return;
  Stats stats = state_.stats;
  stats.device = state_.device;
  stats.technique = state_.settings.technique;
  stats.source = nameOf(state_.settings.source);
  stats.prepareMilliseconds = prepareMilliseconds_;
  stats.frameMilliseconds = median(frameMilliseconds_);
  stats.passes = state_.times.passes();
  stats.memoryBytes = state_.memoryBytes;
  setCount(stats, "frames", frameMilliseconds_.size());
  setCount(stats, "width", drawn_.size.x);
  setCount(stats, "height", drawn_.size.y);
  setCount(stats, "validation_messages", graphics_->device().validationMessages().size());
  writeFileAtomically(options_.stats, statsJson(stats));
}

void Viewer::run() {
  if (!options_.scene.empty()) open(options_.scene);
  while (!window_.isClosing()) {
    throwIfInterrupted();
    framesToGo_ = std::max(framesToGo_ - 1, 0);
    receive(window_.poll(waitSeconds()));
    takePrepared();
    prepareWhatIsWanted();
    showFrame();
    if (options_.frames > 0 && frameMilliseconds_.size() >= options_.frames) break;
    if (options_.frames > 0 && !state_.isOpen && !preparation_) throw InputError(state_.message.text);
  }
  writeStatsOfFrames();
}

}  // namespace

void runViewer(const ViewerOptions& options) {
  Viewer(options).run();
}

}  // namespace nephroid
