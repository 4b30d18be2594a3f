// The viewer taken frame by frame: a real window, and hands that reach it as the desktop does.
#pragma once

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <fstream>

#include "core/image_io.h"
#include "panels.h"
#include "support/ball_in_view.h"
#include "support/hidden_display.h"
#include "support/run_program.h"
#include "techniques/planes/settings.h"
#include "viewer/picking.h"
#include "viewer_loop.h"

namespace nephroid {

namespace fs = std::filesystem;

inline constexpr uvec2 kSize{96, 72};

inline constexpr const char* kPool = R"([camera]
position = [0, 2.5, 0.5]
target = [0, 0, 0]
exposure = 0.00007
[environment]
ambient = 7000
[[material]]
name = "water"
type = "dielectric"
ior = 1.33
[[material]]
name = "tiles"
type = "diffuse"
[[object]]
name = "water"
shape = "water"
size = [3, 3]
grid = [33, 33]
material = "water"
[[object]]
name = "floor"
shape = "plane"
size = [3, 3]
translation = [0, -0.8, 0]
material = "tiles"
[[light]]
type = "directional"
direction = [0.2, -1, -0.15]
illuminance = 60000
)";

// A frame that does not wait for something to happen.
inline bool stepNow(Viewer& viewer) {
  glfwPostEmptyEvent();
  return viewer.step();
}

// What the desktop tells a window. Positions are pixels of the picture.
class Hands {
 public:
  explicit Hands(Viewer& viewer) : viewer_(viewer), window_(viewer.window().handle()) {}

  void moveTo(vec2 pixel) {
    const float left = viewer_.state().arePanelsShown ? kPanelWidth : 0;
    call(glfwSetCursorPosCallback, double(left + pixel.x), double(pixel.y));
  }
  void press(int button = GLFW_MOUSE_BUTTON_LEFT) { call(glfwSetMouseButtonCallback, button, GLFW_PRESS, 0); }
  void release(int button = GLFW_MOUSE_BUTTON_LEFT) {
    call(glfwSetMouseButtonCallback, button, GLFW_RELEASE, 0);
  }
  void click(vec2 pixel) { drag(pixel, pixel); }
  void drag(vec2 from, vec2 to) {
    moveTo(from);
    stepNow(viewer_);
    press();
    stepNow(viewer_);
    for (const float part : {0.5f, 1.0f}) {
      moveTo(mix(from, to, part));
      stepNow(viewer_);
    }
    release();
    stepNow(viewer_);
  }
  void scroll(double steps) { call(glfwSetScrollCallback, 0.0, steps); }
  void key(int key, int modifiers = 0) {
    call(glfwSetKeyCallback, key, 0, GLFW_PRESS, modifiers);
    call(glfwSetKeyCallback, key, 0, GLFW_RELEASE, modifiers);
    stepNow(viewer_);
  }
  void drop(const fs::path& file) {
    const std::string name = file.string();
    const char* names[] = {name.c_str()};
    call(glfwSetDropCallback, 1, static_cast<const char**>(names));
  }

 private:
  template <class Callback, class... Arguments>
  void call(Callback (*set)(GLFWwindow*, Callback), Arguments... arguments) {
    const Callback callback = set(window_, nullptr);
    set(window_, callback);
    callback(window_, arguments...);
  }

  Viewer& viewer_;
  GLFWwindow* window_;
};

class ViewSteps : public HiddenDisplayTest {
 protected:
  void SetUp() override {
    HiddenDisplayTest::SetUp();
    if (IsSkipped()) return;
    setenv("DISPLAY", display_.c_str(), 1);
    setenv("NEPHROID_VALIDATION", "1", 1);
    setenv("XDG_CONFIG_HOME", (folder_ / "config").c_str(), 1);
    before_ = fs::current_path();
    fs::current_path(folder_.path());
    options_.size = kSize;
    options_.waitsForFrames = true;
    options_.settings.technique.transport.source = Source::traced;
    options_.settings.technique.own.of<PlaneSettings>().textureSize = 64;
    viewer_ = std::make_unique<Viewer>(options_);
    viewer_->state().areTimesShown = false;  // they would lie over so small a picture
  }
  void TearDown() override {
    if (before_.empty()) return;  // skipped before it began
    if (viewer_)
      for (const std::string& message : viewer_->device().validationMessages()) ADD_FAILURE() << message;
    viewer_.reset();
    fs::current_path(before_);
  }

  static void TearDownTestSuite() {
    glfwTerminate();  // before its display
    HiddenDisplayTest::TearDownTestSuite();
  }

  Viewer& viewer() { return *viewer_; }
  ViewerState& state() { return viewer_->state(); }
  Hands hands() { return Hands(*viewer_); }

  fs::path written(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return folder_ / name;
  }

  template <class Condition>
  ::testing::AssertionResult stepUntil(const Condition& condition) {
    if (waitUntil([&] { return stepNow(*viewer_) && condition(); }, std::chrono::milliseconds(0)))
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << state().message.text;
  }
  // Its picture is there, and nothing else is to come.
  ::testing::AssertionResult opens(const fs::path& file) {
    hands().drop(file);
    return stepUntil([&] { return state().file == file && !state().preparing; });
  }

  // What `nephroid render` makes of a file.
  ByteImage rendered(const fs::path& scene, const std::string& time = "0", uint32_t samples = 1) const {
    const uvec2 size = kSize;
    const ProgramResult result =
        runProgram({"render", scene.string(), "--source", "traced", "--texture-size", "64", "--time", time,
                    "--size", std::to_string(size.x) + "x" + std::to_string(size.y), "--samples",
                    std::to_string(samples), "-o", (folder_ / "render.png").string()},
                   "-u NEPHROID_VALIDATION");
    EXPECT_EQ(result.status, 0) << result.errors;
    return readPng(folder_ / "render.png");
  }

  TemporaryFolder folder_;
  fs::path before_;
  ViewerOptions options_;
  std::unique_ptr<Viewer> viewer_;
};

// As its panel does. A sky is turned.
inline void moveFirstLight(Viewer& viewer) {
  Scene& scene = viewer.state().scene;
  const std::vector<Handle> handles = handlesOf(scene);
  if (handles.empty()) {
    scene.lights.front().skyRotation += 60;
  } else {
    const float far = distance(handles[0].position, scene.camera.target);
    moveHandle(scene, handles[0], handles[0].position + 0.15f * far * vec3(1, 0, 0));
  }
  stepNow(viewer);
}

}  // namespace nephroid
