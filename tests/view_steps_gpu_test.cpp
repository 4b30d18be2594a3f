// The viewer taken frame by frame: a real window, and hands that reach it as the desktop does.
#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <optional>
#include <regex>
#include <span>

#include "core/image_io.h"
#include "hidden_display.h"
#include "panels.h"
#include "run_program.h"
#include "scene/load.h"
#include "scene/scene_toml.h"
#include "viewer/picking.h"
#include "viewer_loop.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr uvec2 kSize{96, 72};

constexpr const char* kBall = R"([camera]
position = [0, 1.5, 3]
target = [0, 0.4, 0]
exposure = 0.22
[environment]
ambient = 1.2
[[material]]
name = "glass"
type = "dielectric"
[[material]]
name = "floor"
type = "diffuse"
[[object]]
name = "floor"
shape = "plane"
size = [6, 6]
material = "floor"
[[object]]
name = "ball"
shape = "sphere"
radius = 0.5
vertices = 200
material = "glass"
translation = [0, 0.8, 0]
[[light]]
type = "point"
position = [0.6, 1.5, 0.4]
intensity = 20
)";

constexpr const char* kPool = R"([camera]
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
bool stepNow(Viewer& viewer) {
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
    options_.technique.source = Source::traced;
    options_.technique.textureSize = 64;
    viewer_ = std::make_unique<Viewer>(options_);
    viewer_->state().areTimesShown = false;  // they would lie over so small a picture
  }
  void TearDown() override {
    if (IsSkipped()) return;
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
  ByteImage rendered(const fs::path& scene, const std::string& time = "0") const {
    const uvec2 size = kSize;
    const ProgramResult result = runProgram(
        {"render", scene.string(), "--source", "traced", "--texture-size", "64", "--time", time, "--size",
         std::to_string(size.x) + "x" + std::to_string(size.y), "-o", (folder_ / "render.png").string()},
        "-u NEPHROID_VALIDATION");
    EXPECT_EQ(result.status, 0) << result.errors;
    return readPng(folder_ / "render.png");
  }

  TemporaryFolder folder_;
  fs::path before_;
  ViewerOptions options_;
  std::unique_ptr<Viewer> viewer_;
};

std::size_t stonesIn(const ViewerState& state) {
  const auto& simulation = state.scene.objects.at(0).water->simulation;
  return simulation ? simulation->drops.size() : 0;
}

TEST_F(ViewSteps, AClickOnWaterDropsAStoneThatIsSavedWithTheScene) {
  const fs::path file = written("pool.toml", kPool);
  ASSERT_TRUE(opens(file));
  hands().click({40, 30});
  ASSERT_EQ(stonesIn(state()), 1u);
  EXPECT_TRUE(state().isPlaying);
  EXPECT_EQ(state().selection.what, Chosen::nothing);
  state().isPlaying = false;
  viewer().setTime(0.5);
  stepNow(viewer());
  const ByteImage moved = viewer().picture();
  hands().key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  EXPECT_EQ(stonesIn(state()), 0u);
  EXPECT_GT(largestDifference(viewer().picture(), moved), 3u);
  hands().key(GLFW_KEY_Y, GLFW_MOD_CONTROL);
  EXPECT_EQ(stonesIn(state()), 1u);
  EXPECT_FALSE(viewer().isSaved());
  ASSERT_TRUE(viewer().save());
  EXPECT_TRUE(viewer().isSaved());
  EXPECT_LE(largestDifference(rendered(file, "0.5"), moved), 1u);
}

TEST_F(ViewSteps, EachDragOfTheCameraIsTakenBackByItself) {
  const fs::path file = written("ball.toml", kBall);
  state().settings.technique = "none";
  ASSERT_TRUE(opens(file));
  const Camera first = state().scene.camera;
  hands().drag({70, 60}, {50, 55});
  const Camera second = state().scene.camera;
  hands().drag({70, 60}, {60, 65});
  const Camera third = state().scene.camera;
  for (int i = 0; i < 3; ++i) {
    hands().scroll(1);
    stepNow(viewer());
  }
  EXPECT_NE(state().scene.camera, third);
  EXPECT_TRUE(viewer().isSaved());
  for (const Camera& camera : {third, second, first, first}) {
    hands().key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    EXPECT_EQ(state().scene.camera, camera);
  }
}

// Of few vertices: finer shapes take long, and show no more of the viewer. Meshes of files stay as they are.
std::string coarse(const fs::path& scene) {
  const std::regex ofMesh("(mesh = .*(\\n[^\\[\\n].*)*?)\\nvertices = [0-9]+");
  const std::string text = std::regex_replace(readSceneFile(scene), ofMesh, "$1");
  const std::string few = std::regex_replace(text, std::regex("\\nvertices = [0-9]+"), "\nvertices = 600");
  return std::regex_replace(
      std::regex_replace(few, std::regex("\\ngrid = \\[[0-9, ]+\\]"), "\ngrid = [24, 24]"),
      std::regex("\\nsamples = [0-9]+"), "\nsamples = 2");
}

// As its panel does. A sky is turned.
void moveFirstLight(Viewer& viewer) {
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

bool isOneColor(const ByteImage& picture) {
  const auto pixel = std::span(picture.bytes).first(picture.components);
  for (std::size_t i = 0; i < picture.bytes.size(); i += picture.components)
    if (!std::ranges::equal(std::span(picture.bytes).subspan(i, picture.components), pixel)) return false;
  return true;
}

// Stands for the bunny, which takes long to follow light through.
constexpr const char* kSmallBunny = R"(v -0.5 0 -0.5
v 0.5 0 -0.5
v 0 0 0.5
v 0 0.8 0
f 1 2 3
f 1 4 2
f 2 4 3
f 3 4 1
)";

// One after another in one window; all are saved, and some are rendered from what was saved.
TEST_F(ViewSteps, OpensEachSceneAndItsPictureFollowsTheLight) {
  const fs::path scenes = fs::path(NEPHROID_SOURCE_DIR) / "scenes";
  for (const char* name : {"polka-dots.png", "evening-sky.exr"}) fs::copy(scenes / name, folder_ / name);
  written("bunny.obj", kSmallBunny);
  const std::vector<std::string> saved{"glass-ball.toml", "knot-spotlight.toml", "water-drops.toml",
                                       "paper4-stage.toml"};
  std::size_t opened = 0;
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const fs::path file = written(name, coarse(entry.path()));
    ASSERT_TRUE(opens(file));
    const ByteImage first = viewer().picture();
    EXPECT_FALSE(isOneColor(first));
    moveFirstLight(viewer());
    EXPECT_GT(largestDifference(viewer().picture(), first), 0u);
    EXPECT_FALSE(viewer().isSaved());
    ASSERT_TRUE(viewer().save()) << state().message.text;
    if (std::ranges::count(saved, name) > 0) {
      EXPECT_LE(largestDifference(viewer().picture(), rendered(file)), 1u);
    }
    ++opened;
  }
  EXPECT_GT(opened, 30u);
}

TEST_F(ViewSteps, WhatIsDroppedIsOpenedOrAddedOrTheWindowSaysWhyNot) {
  state().settings.technique = "none";
  ASSERT_TRUE(opens(written("ball.toml", kBall)));
  hands().drop(written("picture.jpg", ""));
  stepNow(viewer());
  EXPECT_NE(state().message.text.find("what can be dropped"), std::string::npos);
  hands().drop(written("wrong.toml", "[camera\n"));
  ASSERT_TRUE(stepUntil([&] { return state().message.text.find("wrong.toml:1") != std::string::npos; }));
  EXPECT_EQ(state().scene.objects.size(), 2u);
  hands().drop(
      written("tent.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
  ASSERT_TRUE(stepUntil([&] { return state().scene.objects.size() == 3; }));
  EXPECT_FALSE(viewer().isSaved());
  hands().drop(written("other.toml", kBall));
  stepNow(viewer());
  ASSERT_TRUE(state().question);
  state().question->answer = Question::Answer::cancel;
  stepNow(viewer());
  EXPECT_EQ(state().scene.objects.back().name, "tent");
}

// In the frame that takes it in.
TEST_F(ViewSteps, WhatAHandDoesIsSeenInTheNextFrame) {
  ASSERT_TRUE(opens(written("ball.toml", kBall)));
  const vec2 from = *pixelOf(state().scene.camera, kSize, state().scene.lights[0].position);
  hands().moveTo(from);
  stepNow(viewer());
  hands().press();
  stepNow(viewer());
  for (int i = 1; i <= 5; ++i) {
    const ByteImage before = viewer().picture();
    hands().moveTo(from - vec2(5 * i, 0));
    int frames = 0;
    do {
      stepNow(viewer());
      ++frames;
    } while (viewer().picture().bytes == before.bytes && frames < 10);
    EXPECT_EQ(frames, 1);
  }
}

VkResult VKAPI_PTR loseTheDevice(VkQueue, uint32_t, const VkSubmitInfo2*, VkFence) {
  return VK_ERROR_DEVICE_LOST;
}

TEST_F(ViewSteps, ALostDeviceIsMadeAnewAndNothingElseIsLost) {
  const fs::path file = written("ball.toml", kBall);
  ASSERT_TRUE(opens(file));
  moveFirstLight(viewer());
  const ByteImage before = viewer().picture();
  const auto hasPicture = [&] { return !state().outputs.empty(); };
  vkQueueSubmit2 = loseTheDevice;  // until another device is made
  stepNow(viewer());
  EXPECT_NE(state().message.text.find("the device was lost"), std::string::npos);
  EXPECT_FALSE(viewer().isSaved());
  ASSERT_TRUE(stepUntil(hasPicture));
  EXPECT_EQ(largestDifference(viewer().picture(), before), 0u);

  // Soon again: what loses it is not tried over and over.
  vkQueueSubmit2 = loseTheDevice;
  for (int i = 0; i < 5; ++i) stepNow(viewer());
  EXPECT_FALSE(hasPicture());
  EXPECT_TRUE(viewer().save());
  EXPECT_NE(loadScene(file).lights[0].position, loadScene(written("first.toml", kBall)).lights[0].position);
  moveFirstLight(viewer());
  EXPECT_TRUE(stepUntil(hasPicture));
}

// A variable of the environment, as it was before when this ends.
class Variable {
 public:
  Variable(const char* name, const char* value) : name_(name) {
    if (const char* before = std::getenv(name)) before_ = before;
    setenv(name, value, 1);
  }
  ~Variable() {
    if (before_)
      setenv(name_, before_->c_str(), 1);
    else
      unsetenv(name_);
  }
  Variable(const Variable&) = delete;
  Variable& operator=(const Variable&) = delete;

 private:
  const char* name_;
  std::optional<std::string> before_;
};

TEST_F(ViewSteps, WhereNoDeviceIsLeftWhatWasNotSavedIsInAFileBesideIt) {
  ASSERT_TRUE(opens(written("ball.toml", kBall)));
  moveFirstLight(viewer());
  const vec3 moved = state().scene.lights[0].position;
  vkQueueSubmit2 = loseTheDevice;
  try {
    const Variable icds("VK_ICD_FILENAMES", "/nowhere.json"), drivers("VK_DRIVER_FILES", "/nowhere.json");
    stepNow(viewer());
    ADD_FAILURE() << "goes on without a device";
  } catch (const RuntimeFailure& failure) {
    EXPECT_NE(std::string(failure.what()).find("ball-unsaved.toml"), std::string::npos) << failure.what();
  }
  viewer_.reset();
  EXPECT_EQ(readAll(folder_ / "ball.toml"), kBall);
  EXPECT_EQ(loadScene(folder_ / "ball-unsaved.toml").lights[0].position, moved);
}

struct Held {
  uint64_t allocations = 0, bytes = 0;
  bool operator==(const Held&) const = default;
};

// Bytes of this process in memory.
std::size_t resident() {
  std::ifstream file("/proc/self/statm");
  std::size_t size = 0, pages = 0;
  file >> size >> pages;
  return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
}

// As many as NEPHROID_TEST_FRAMES asks for; few where a suite has to be short.
int frameCount() {
  const char* wanted = std::getenv("NEPHROID_TEST_FRAMES");
  return wanted ? std::atoi(wanted) : 120;
}

// Frames in which the light moves, the window is made larger, smaller, hidden and shown, and views are
// switched: after each round of them the device holds what it held after the first, which grows buffers to
// what the largest frame needs.
TEST_F(ViewSteps, FramesLeaveNothingBehind) {
  ASSERT_TRUE(opens(written("ball.toml", kBall)));
  const uvec2 size = viewer().window().size();
  const vec3 place = state().scene.lights[0].position;
  GLFWwindow* window = viewer().window().handle();
  constexpr int kRound = 40;
  std::vector<Held> held;
  std::vector<std::size_t> hosts;
  for (int frame = 1; frame <= frameCount(); ++frame) {
    state().scene.lights[0].position = place + vec3(0.01f * float(frame % 7), 0, 0);
    stepNow(viewer());
    const int inRound = frame % kRound;
    if (inRound % 10 == 0) {
      const uvec2 wanted = size + uvec2(uint32_t(inRound), uint32_t(inRound % 20));
      viewer().window().resize(wanted);
      ASSERT_TRUE(stepUntil([&] { return viewer().window().framebufferSize() == wanted; }));
    }
    if (inRound == 12 || inRound == 33) hands().key(GLFW_KEY_1);
    if (inRound == 16 || inRound == 36) hands().key(GLFW_KEY_7);
    if (inRound == 20) glfwHideWindow(window);
    if (inRound == 23) glfwShowWindow(window);
    if (inRound != 0) continue;
    held.push_back({viewer().device().memory().allocationCount(), viewer().device().memoryBytes()});
    hosts.push_back(resident());
  }
  ASSERT_GE(held.size(), 3u);
  for (const Held& later : held) EXPECT_EQ(later, held[0]) << &later - held.data();
  EXPECT_LT(double(hosts.back()), 1.1 * double(hosts[hosts.size() / 2]));
}

TEST_F(ViewSteps, GoesOnWhereItWasWhenItIsNoLongerMinimised) {
  if (!isInstalled("twm")) GTEST_SKIP() << "there is no window manager that minimises windows (package twm)";
  const fs::path settings =
      written("twmrc",
              "RandomPlacement\nTitleFont \"fixed\"\nMenuFont \"fixed\"\nIconFont \"fixed\"\n"
              "ResizeFont \"fixed\"\nIconManagerFont \"fixed\"\n");
  const Process manager({"twm", "-f", settings.string()}, {"DISPLAY=" + display_}, folder_.path(),
                        folder_ / "twm");
  ASSERT_TRUE(opens(written("ball.toml", kBall)));
  GLFWwindow* window = viewer().window().handle();
  // The manager may not be there yet.
  ASSERT_TRUE(stepUntil([&] {
    glfwIconifyWindow(window);
    return viewer().window().framebufferSize() == uvec2(0);
  })) << readAll(folder_ / "twm");
  const ByteImage before = viewer().picture();
  state().scene.lights[0].position.x -= 0.3f;
  for (int i = 0; i < 3; ++i) stepNow(viewer());
  EXPECT_EQ(largestDifference(viewer().picture(), before), 0u);
  glfwRestoreWindow(window);
  EXPECT_TRUE(stepUntil([&] { return largestDifference(viewer().picture(), before) > 0; }));
}

TEST_F(ViewSteps, RecordsWhatIsSeenAsAVideo) {
  state().settings.technique = "none";
  ASSERT_TRUE(opens(written("ball.toml", kBall)));
  hands().key(GLFW_KEY_V);
  if (!isInstalled("ffmpeg")) {
    EXPECT_NE(state().message.text.find("install package ffmpeg"), std::string::npos) << state().message.text;
    GTEST_SKIP() << "there is no ffmpeg";
  }
  constexpr int kFrames = 6;
  for (int i = 0; i < kFrames; ++i) {
    state().scene.lights[0].position.x -= 0.1f;
    stepNow(viewer());
  }
  hands().key(GLFW_KEY_V);
  EXPECT_TRUE(state().recording.empty());
  const std::string answer = (folder_ / "answer").string();
  ASSERT_EQ(
      std::system(
          ("ffprobe -v error -count_frames -show_entries stream=width,height,nb_read_frames -of csv=p=0 '" +
           (folder_ / "ball-001.mp4").string() + "' >'" + answer + "' 2>&1")
              .c_str()),
      0);
  EXPECT_EQ(readAll(answer),
            std::to_string(kSize.x) + "," + std::to_string(kSize.y) + "," + std::to_string(kFrames) + "\n");
}

}  // namespace
}  // namespace nephroid
