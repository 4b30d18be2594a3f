// The viewer driven as a person would: a real window, on a display of its own, under a mouse and keys that
// xdotool moves.
#include <gtest/gtest.h>

#include <chrono>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/image_io.h"
#include "formats/load.h"
#include "support/ball_in_view.h"
#include "support/hidden_display.h"
#include "support/run_program.h"
#include "viewer/picking.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr uvec2 kSize{160, 120};
constexpr float kPanelWidth = 330;

// Tables and volumes are small here: what is looked at is the viewer.
const std::vector<std::string> kQuick{"--texture-size",        "64",      "--directions",     "9",
                                      "--light-level",         "0",       "--volume-photons", "1",
                                      "--light-interpolation", "nearest", "--samples",        "4"};

class ViewWindow : public HiddenDisplayTest {
 protected:
  void SetUp() override {
    HiddenDisplayTest::SetUp();
    std::ofstream(folder_ / "scene.toml") << kBallInView;
  }

  std::unique_ptr<Process> view(const std::vector<std::string>& arguments, uvec2 size = kSize) const {
    std::vector<std::string> command{NEPHROID_PROGRAM, "view", (folder_ / "scene.toml").string(), "--size",
                                     std::to_string(size.x) + "x" + std::to_string(size.y)};
    command.insert(command.end(), kQuick.begin(), kQuick.end());
    command.insert(command.end(), arguments.begin(), arguments.end());
    return std::make_unique<Process>(
        command,
        std::vector<std::string>{"DISPLAY=" + display_, "NEPHROID_VALIDATION=1",
                                 "XDG_CONFIG_HOME=" + (folder_ / "config").string()},
        folder_ / "", folder_ / "log");
  }

  // What a shell is told so that xdotool does it; its answers go into a file.
  std::string xdotool(const std::string& commands) const {
    return "DISPLAY=" + display_ + " xdotool " + commands + " >'" + (folder_ / "answer").string() + "' 2>&1";
  }
  void type(const std::string& commands) const {
    ASSERT_EQ(std::system(xdotool(commands).c_str()), 0) << commands << readAll(folder_ / "answer");
  }
  bool isTitled(const std::string& title) const {
    return std::system(xdotool("search --name '" + title + "'").c_str()) == 0;
  }
  ::testing::AssertionResult becomes(const std::string& title, Process& process) const {
    if (waitUntil([&] { return !process.isRunning() || isTitled(title); }) && process.isRunning())
      return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "the window is not called '" << title << "'\n"
                                         << readAll(folder_ / "log");
  }
  bool appears(const std::string& name) const {
    return waitUntil([&] { return fs::exists(folder_ / name); });
  }

  // As `nephroid render` has it, in render.png.
  void render(const std::string& technique) const {
    std::vector<std::string> command{"render",      (folder_ / "scene.toml").string(),
                                     "--technique", technique,
                                     "--size",      std::to_string(kSize.x) + "x" + std::to_string(kSize.y),
                                     "-o",          (folder_ / "render.png").string()};
    command.insert(command.end(), kQuick.begin(), kQuick.end());
    ASSERT_EQ(runProgram(command).status, 0);
  }

  // No validation message, and done.
  nlohmann::json endedWell(Process& process) const {
    EXPECT_EQ(process.wait(), 0) << readAll(folder_ / "log");
    const nlohmann::json stats = nlohmann::json::parse(readAll(folder_ / "stats.json"), nullptr, false);
    EXPECT_EQ(stats["counts"]["validation_messages"], 0) << readAll(folder_ / "log");
    return stats;
  }

  TemporaryFolder folder_;
};

std::string numbered(int number) {
  char name[32];
  std::snprintf(name, sizeof name, "scene-%03d.png", number);
  return name;
}

std::string at(vec2 pixel) {
  return std::to_string(std::lround(kPanelWidth + pixel.x)) + " " + std::to_string(std::lround(pixel.y));
}

uint32_t largestDifference(const fs::path& a, const fs::path& b) {
  return largestDifference(readPng(a), readPng(b));
}

// The light is dragged, the scene saved, and what each technique shows is what `nephroid render` makes of the
// saved scene.
TEST_F(ViewWindow, ShowsWhatRenderMakesOfTheSavedScene) {
  const Scene before = loadScene(folder_ / "scene.toml");
  const auto process = view({"--stats", (folder_ / "stats.json").string()});
  ASSERT_TRUE(becomes("^scene.toml - adaptive-beams", *process));
  type("key t");  // the times would lie over so small a picture
  const vec2 light = *pixelOf(before.camera, kSize, before.lights[0].position);
  type("mousemove " + at(light) + " mousedown 1 sleep 0.1 mousemove " + at(light + vec2(-6, 3)) +
       " sleep 0.1 mousemove " + at(light + vec2(-25, 6)) + " sleep 0.2 mouseup 1");
  ASSERT_TRUE(becomes("^scene.toml\\* - adaptive-beams", *process));
  type("key ctrl+s");
  ASSERT_TRUE(becomes("^scene.toml - adaptive-beams", *process));
  const Scene after = loadScene(folder_ / "scene.toml");
  EXPECT_LT(after.lights[0].position.x, 0.5);
  EXPECT_NE(readAll(folder_ / "scene.toml").find("[[light]] # moved by hand"), std::string::npos);

  int number = 0;
  for (const char* technique : {"adaptive-beams", "illumination-textures", "irradiance-volume",
                                "light-volumes", "sliced-images", "none"}) {
    SCOPED_TRACE(technique);
    if (number > 0) type("key m");
    ASSERT_TRUE(becomes(std::string("^scene.toml - ") + technique, *process));
    type("key p");
    const std::string shot = numbered(++number);
    ASSERT_TRUE(appears(shot)) << readAll(folder_ / "log");
    render(technique);
    EXPECT_LE(largestDifference(folder_ / shot, folder_ / "render.png"), 1u);
  }
  type("key ctrl+q");
  endedWell(*process);
}

// Undone, every change is gone, and closing asks first where one is not.
TEST_F(ViewWindow, AsksBeforeChangesAreLost) {
  const Scene before = loadScene(folder_ / "scene.toml");
  const auto process = view({"--technique", "none", "--stats", (folder_ / "stats.json").string()});
  ASSERT_TRUE(becomes("^scene.toml - none", *process));
  type("key t");  // the times would lie over so small a picture
  const vec2 light = *pixelOf(before.camera, kSize, before.lights[0].position);
  const std::string drag = "mousemove " + at(light) + " mousedown 1 sleep 0.1 mousemove " +
                           at(light + vec2(-9, 3)) + " sleep 0.2 mouseup 1";
  type(drag);
  ASSERT_TRUE(becomes("^scene.toml\\* - none", *process));
  type("key ctrl+z");
  ASSERT_TRUE(becomes("^scene.toml - none", *process));
  type("key ctrl+y");
  ASSERT_TRUE(becomes("^scene.toml\\* - none", *process));
  type("key ctrl+q sleep 0.5");
  EXPECT_TRUE(process->isRunning());
  EXPECT_EQ(readAll(folder_ / "scene.toml"), kBallInView);
  type("key Escape sleep 0.3 key ctrl+z");
  ASSERT_TRUE(becomes("^scene.toml - none", *process));
  type("key ctrl+q");
  endedWell(*process);
}

TEST_F(ViewWindow, GoesWithTheFileAndSaysWhatIsWrongWithIt) {
  const auto process = view({"--technique", "none", "--stats", (folder_ / "stats.json").string()});
  ASSERT_TRUE(becomes("^scene.toml - none", *process));
  std::ofstream(folder_ / "scene.toml") << "[camera\n";
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));
  EXPECT_TRUE(process->isRunning());
  std::string brighter = kBallInView;
  brighter.replace(brighter.find("exposure = 0.22"), 15, "exposure = 0.90");
  std::ofstream(folder_ / "scene.toml") << brighter;
  render("none");
  int number = 0;
  EXPECT_TRUE(waitUntil([&] {
    type("key p");
    const std::string shot = numbered(++number);
    return appears(shot) && largestDifference(folder_ / shot, folder_ / "render.png") <= 1;
  }));
  type("key ctrl+q");
  endedWell(*process);
}

// Of a screen on which the user wants two pixels for one: panels and letters are twice as large, and the
// picture is of the size that was asked for.
TEST_F(ViewWindow, IsTwiceAsLargeOnADenseScreen) {
  if (!isInstalled("xprop")) GTEST_SKIP() << "there is no xprop (package x11-utils)";
  const auto setDensity = [&](const std::string& dots) {
    return std::system(("DISPLAY=" + display_ +
                        " xprop -root -f RESOURCE_MANAGER 8s -set RESOURCE_MANAGER 'Xft.dpi: " + dots + "'")
                           .c_str());
  };
  ASSERT_EQ(setDensity("192"), 0);
  constexpr uvec2 size{320, 60};
  const auto process =
      view({"--technique", "none", "--frames", "3", "--stats", (folder_ / "stats.json").string()}, size);
  const nlohmann::json stats = endedWell(*process);
  setDensity("96");
  EXPECT_EQ(stats["counts"]["width"], size.x);
  EXPECT_EQ(stats["counts"]["height"], size.y);
  EXPECT_EQ(stats["counts"]["window_width"], size.x + 2 * uint32_t(kPanelWidth));
}

// As the window shows it, and without a user; the colors of levels are no grays.
TEST_F(ViewWindow, WritesWhatItShows) {
  const auto process = view({"--show", "levels,planes", "--picture", "levels.png"}, {320, 240});
  EXPECT_EQ(process->wait(), 2);  // there are no planes
  EXPECT_NE(readAll(folder_ / "log").find("--show planes: there is nothing"), std::string::npos);
  EXPECT_FALSE(fs::exists(folder_ / "levels.png"));
  for (const char* shown : {"levels", "beams"}) {
    const std::string file = std::string(shown) + ".png";
    const auto done = view({"--show", shown, "--picture", file}, {320, 240});
    ASSERT_EQ(done->wait(), 0) << readAll(folder_ / "log");
    const ByteImage picture = readPng(folder_ / file);
    ASSERT_EQ(uvec2(picture.width, picture.height), uvec2(320, 240));
    std::size_t colored = 0;
    for (std::size_t i = 0; i < picture.bytes.size(); i += picture.components) {
      const auto [least, most] = std::minmax({picture.bytes[i], picture.bytes[i + 1], picture.bytes[i + 2]});
      if (most - least > 60) ++colored;
    }
    EXPECT_GT(colored, 320u * 240u / 20) << shown;
  }
}

TEST(ViewCommand, SaysInOneLineThatThereIsNoDisplay) {
  const ProgramResult result = runProgram({"view", "scene.toml"}, "-u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
}

}  // namespace
}  // namespace nephroid
