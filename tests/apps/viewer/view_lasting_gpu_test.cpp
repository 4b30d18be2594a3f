// The window goes on: without its device, over many frames, minimized, while it is recorded.
#include "apps/viewer/view_steps.h"

#include <fstream>
#include <optional>

#include "core/accuracy.h"
#include "formats/load.h"

namespace nephroid {
namespace {

VkResult VKAPI_PTR loseTheDevice(VkQueue, uint32_t, const VkSubmitInfo2*, VkFence) {
  return VK_ERROR_DEVICE_LOST;
}

TEST_F(ViewSteps, ALostDeviceIsMadeAnewAndNothingElseIsLost) {
  const fs::path file = written("ball.toml", kBallInView);
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
  EXPECT_NE(loadScene(file).lights[0].position,
            loadScene(written("first.toml", kBallInView)).lights[0].position);
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
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
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
  EXPECT_EQ(readAll(folder_ / "ball.toml"), kBallInView);
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
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
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

TEST_F(ViewSteps, GoesOnWhereItWasWhenItIsNoLongerMinimized) {
  if (!isInstalled("twm")) GTEST_SKIP() << "there is no window manager that minimizes windows (package twm)";
  const fs::path settings =
      written("twmrc",
              "RandomPlacement\nTitleFont \"fixed\"\nMenuFont \"fixed\"\nIconFont \"fixed\"\n"
              "ResizeFont \"fixed\"\nIconManagerFont \"fixed\"\n");
  const Process manager({"twm", "-f", settings.string()}, {"DISPLAY=" + display_}, folder_.path(),
                        folder_ / "twm");
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
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

// A frame whose beams take long: the window goes on beside it, and what is canceled leaves the picture as it
// was.
TEST_F(ViewSteps, GoesOnBesideALongFrameThatCanBeCanceled) {
  viewer_.reset();
  options_.waitsForFrames = false;
  viewer_ = std::make_unique<Viewer>(options_);
  ASSERT_TRUE(stepUntil([&] { return true; }));
  hands().drop(written("ball.toml", kBallInView));
  ASSERT_TRUE(stepUntil([&] { return state().gathered == state().settings.samples.count; }));
  const ByteImage before = viewer().shownPicture();
  const PictureSettings usual = state().settings;

  // Of a new stage: the settings become those of the picture again.
  state().settings.technique.own.of<Accuracy>().error = 1e-6f;
  ASSERT_TRUE(stepUntil([&] { return state().preparing && state().preparing->name == "Drawing"; }));
  state().isPreparationCanceled = true;
  ASSERT_TRUE(stepUntil([&] { return !state().preparing; }));
  EXPECT_NE(state().message.text.find("Canceled"), std::string::npos) << state().message.text;
  EXPECT_EQ(state().settings, usual);
  for (int i = 0; i < 3; ++i) stepNow(viewer());
  EXPECT_FALSE(state().preparing);
  EXPECT_EQ(viewer().shownPicture().bytes, before.bytes);

  // The stage goes on.
  moveFirstLight(viewer());
  EXPECT_TRUE(stepUntil([&] { return state().gathered > 0 && !state().preparing; }));
  EXPECT_GT(largestDifference(viewer().shownPicture(), before), 0u);
}

TEST_F(ViewSteps, RecordsWhatIsSeenAsAVideo) {
  state().settings.technique.technique = "none";
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
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
