// The viewer driven as a person would: a real window, on a display of its own, under a mouse and keys that
// xdotool moves.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <fstream>
#include <nlohmann/json.hpp>
#include <thread>

#include "core/error.h"
#include "core/image_io.h"
#include "gpu/device.h"
#include "run_program.h"
#include "scene/load.h"
#include "viewer/picking.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr uvec2 kSize{160, 120};
constexpr float kPanelWidth = 330;
constexpr auto kPatience = std::chrono::seconds(40);

// Tables and volumes are small here: what is looked at is the viewer.
const std::vector<std::string> kQuick{"--texture-size",        "64",     "--directions",     "9",
                                      "--light-level",         "0",      "--volume-photons", "1",
                                      "--light-interpolation", "nearest"};

constexpr const char* kScene = R"(# A ball over a floor
[camera]
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
vertices = 400
material = "glass"
translation = [0, 0.8, 0]

[[light]] # moved by hand
type = "point"
position = [0.6, 1.5, 0.4]
intensity = 20
)";

// A child process, ended with this.
class Process {
 public:
  Process(const std::vector<std::string>& command, const std::vector<std::string>& environment,
          const fs::path& folder, const fs::path& output) {
    std::vector<char*> arguments;
    for (const std::string& argument : command) arguments.push_back(const_cast<char*>(argument.c_str()));
    arguments.push_back(nullptr);
    id_ = fork();
    if (id_ != 0) return;
    for (const std::string& variable : environment) putenv(const_cast<char*>(variable.c_str()));
    const int file = open(output.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
    dup2(file, STDOUT_FILENO);
    dup2(file, STDERR_FILENO);
    if (chdir(folder.c_str()) == 0) execvp(arguments[0], arguments.data());
    _exit(127);
  }
  ~Process() {
    if (isRunning()) kill(id_, SIGKILL);
    wait();
  }
  Process(const Process&) = delete;
  Process& operator=(const Process&) = delete;

  bool isRunning() {
    if (!isEnded_ && waitpid(id_, &status_, WNOHANG) == id_) isEnded_ = true;
    return !isEnded_;
  }
  int wait() {
    if (!isEnded_) waitpid(id_, &status_, 0);
    isEnded_ = true;
    return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
  }
  // Bytes in memory.
  std::size_t resident() const {
    std::ifstream file("/proc/" + std::to_string(id_) + "/statm");
    std::size_t size = 0, pages = 0;
    file >> size >> pages;
    return pages * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  }

 private:
  pid_t id_ = 0;
  int status_ = 0;
  bool isEnded_ = false;
};

bool isInstalled(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

template <class Condition>
bool waitUntil(const Condition& condition) {
  for (const Clock::time_point end = Clock::now() + kPatience; Clock::now() < end;) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(40));
  }
  return false;
}

// A display that nobody looks at.
class ViewWindow : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!isInstalled("Xvfb") || !isInstalled("xdotool")) return;
    shared_ = std::make_unique<TemporaryFolder>();
    const fs::path number = *shared_ / "display";
    server_ = std::make_unique<Process>(
        std::vector<std::string>{
            "sh", "-c",
            "exec Xvfb -displayfd 3 -noreset -screen 0 1280x720x24 -nolisten tcp 3>" + number.string()},
        std::vector<std::string>{}, *shared_ / "", *shared_ / "log");
    if (waitUntil([&] { return !readAll(number).empty() || !server_->isRunning(); }))
      display_ = "DISPLAY=:" + readAll(number).substr(0, readAll(number).find('\n'));
  }
  static void TearDownTestSuite() {
    server_.reset();
    shared_.reset();
  }

  void SetUp() override {
    try {
      gpu::listDevices();
    } catch (const RuntimeFailure& none) {
      GTEST_SKIP() << "there is no Vulkan driver: " << none.what();
    }
    if (display_.empty()) GTEST_SKIP() << "there is no Xvfb, or no xdotool";
    std::ofstream(folder_ / "scene.toml") << kScene;
  }

  std::unique_ptr<Process> view(std::vector<std::string> arguments) const {
    std::vector<std::string> command{NEPHROID_PROGRAM, "view", (folder_ / "scene.toml").string(), "--size",
                                     std::to_string(kSize.x) + "x" + std::to_string(kSize.y)};
    command.insert(command.end(), kQuick.begin(), kQuick.end());
    command.insert(command.end(), arguments.begin(), arguments.end());
    return std::make_unique<Process>(
        command,
        std::vector<std::string>{display_, "NEPHROID_VALIDATION=1",
                                 "XDG_CONFIG_HOME=" + (folder_ / "config").string()},
        folder_ / "", folder_ / "log");
  }

  // Commands of xdotool.
  void type(const std::string& commands) const {
    const std::string command =
        display_ + " xdotool " + commands + " >'" + (folder_ / "answer").string() + "' 2>&1";
    ASSERT_EQ(std::system(command.c_str()), 0) << commands << readAll(folder_ / "answer");
  }
  bool isTitled(const std::string& title) const {
    const std::string command = display_ + " xdotool search --name '" + title + "' >'" +
                                (folder_ / "answer").string() + "' 2>/dev/null";
    return std::system(command.c_str()) == 0;
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
  inline static std::string display_;
  inline static std::unique_ptr<Process> server_;
  inline static std::unique_ptr<TemporaryFolder> shared_;
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
  const ByteImage one = readPng(a), other = readPng(b);
  if (one.width != other.width || one.height != other.height) return 1000;
  uint32_t largest = 0;
  for (std::size_t i = 0; i < one.bytes.size(); ++i)
    largest = std::max(largest, uint32_t(std::abs(int(one.bytes[i]) - int(other.bytes[i]))));
  return largest;
}

// The light is dragged, the scene saved, and what each technique shows is what `nephroid render` makes of the
// saved scene.
TEST_F(ViewWindow, ShowsWhatRenderMakesOfTheSavedScene) {
  const Scene before = loadScene(folder_ / "scene.toml");
  const auto process = view({"--stats", (folder_ / "stats.json").string()});
  ASSERT_TRUE(becomes("^scene.toml - automatic", *process));
  type("key t");  // the times would lie over so small a picture
  const vec2 light = *pixelOf(before.camera, kSize, before.lights[0].position);
  type("mousemove " + at(light) + " mousedown 1 sleep 0.1 mousemove " + at(light + vec2(-6, 3)) +
       " sleep 0.1 mousemove " + at(light + vec2(-25, 6)) + " sleep 0.2 mouseup 1");
  ASSERT_TRUE(becomes("^scene.toml\\* - automatic", *process));
  type("key ctrl+s");
  ASSERT_TRUE(becomes("^scene.toml - automatic", *process));
  const Scene after = loadScene(folder_ / "scene.toml");
  EXPECT_LT(after.lights[0].position.x, 0.5);
  EXPECT_NE(readAll(folder_ / "scene.toml").find("[[light]] # moved by hand"), std::string::npos);

  int number = 0;
  for (const char* technique : {"automatic", "illumination-textures", "irradiance-volume", "light-volumes",
                                "sliced-images", "none"}) {
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
  EXPECT_EQ(readAll(folder_ / "scene.toml"), kScene);
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
  std::string brighter = kScene;
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

// As many as NEPHROID_TEST_FRAMES asks for; few where a suite has to be short.
std::string frameCount() {
  const char* wanted = std::getenv("NEPHROID_TEST_FRAMES");
  return wanted ? wanted : "300";
}

// Frames in which the camera goes around, the window is made larger, smaller, hidden and shown,
// and views are switched: what is allocated at the end is what was soon after the beginning.
TEST_F(ViewWindow, FramesLeaveNothingBehind) {
  const auto process =
      view({"--source", "traced", "--frames", frameCount(), "--stats", (folder_ / "stats.json").string()});
  ASSERT_TRUE(becomes("^scene.toml", *process));
  std::vector<std::size_t> resident;
  const std::vector<std::string> sizes{"520 140", "470 100", "600 160", "490 120"};
  for (std::size_t i = 0; process->isRunning(); ++i) {
    const std::string size = sizes[i % sizes.size()];
    const std::string commands =
        "mousemove 400 60 mousedown 1 mousemove_relative 15 5 mousemove_relative 9 -6 mouseup 1 "
        "search --name '^scene.toml' windowsize " +
        size + (i % 3 == 2 ? " windowunmap windowmap" : "") + " key 1 key 7 key t";
    // It may end meanwhile.
    if (std::system((display_ + " xdotool " + commands + " >/dev/null 2>&1").c_str()) == -1) break;
    resident.push_back(process->resident());
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  const nlohmann::json stats = endedWell(*process);
  EXPECT_EQ(std::to_string(stats["counts"]["frames"].get<int>()), frameCount());
  ASSERT_GT(resident.size(), 8u);
  const auto most = [&](std::size_t from, std::size_t to) {
    return *std::max_element(resident.begin() + std::ptrdiff_t(from), resident.begin() + std::ptrdiff_t(to));
  };
  const std::size_t half = resident.size() / 2, last = resident.size() - 1;
  constexpr double kSlack = 1.1;  // the host's allocator, and sizes of windows that come in another order
  EXPECT_LT(double(most(half, last)), kSlack * double(most(resident.size() / 4, half)));
}

TEST(ViewCommand, SaysInOneLineThatThereIsNoDisplay) {
  const ProgramResult result = runProgram({"view", "scene.toml"}, "-u DISPLAY -u WAYLAND_DISPLAY");
  EXPECT_EQ(result.status, 2);
  EXPECT_TRUE(result.hasOneLineOfErrors()) << result.errors;
}

}  // namespace
}  // namespace nephroid
