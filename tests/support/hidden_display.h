// Windows on a display that nobody looks at.
#pragma once

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "core/error.h"
#include "core/image.h"
#include "gpu/device.h"
#include "support/temporary_folder.h"

namespace nephroid {

// A child process, ended with this.
class Process {
 public:
  Process(const std::vector<std::string>& command, const std::vector<std::string>& environment,
          const std::filesystem::path& folder, const std::filesystem::path& output) {
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

 private:
  pid_t id_ = 0;
  int status_ = 0;
  bool isEnded_ = false;
};

inline bool isInstalled(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

template <class Condition>
bool waitUntil(const Condition& condition, std::chrono::milliseconds pause = std::chrono::milliseconds(40)) {
  using Clock = std::chrono::steady_clock;
  constexpr auto kPatience = std::chrono::seconds(40);
  for (const Clock::time_point end = Clock::now() + kPatience; Clock::now() < end;) {
    if (condition()) return true;
    std::this_thread::sleep_for(pause);
  }
  return false;
}

// Of colors, gray levels; 1000 for pictures of different sizes.
inline uint32_t largestDifference(const ByteImage& one, const ByteImage& other) {
  if (one.width != other.width || one.height != other.height) return 1000;
  uint32_t largest = 0;
  for (std::size_t pixel = 0; pixel < std::size_t{one.width} * one.height; ++pixel)
    for (std::size_t c = 0; c < 3; ++c)
      largest = std::max(largest, uint32_t(std::abs(int(one.bytes[pixel * one.components + c]) -
                                                    int(other.bytes[pixel * other.components + c]))));
  return largest;
}

// A display of the test program's own, and skipped where there is none or no Vulkan driver.
class HiddenDisplayTest : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    if (!isInstalled("Xvfb") || !isInstalled("xdotool")) return;
    shared_ = std::make_unique<TemporaryFolder>();
    const std::filesystem::path number = *shared_ / "display";
    server_ = std::make_unique<Process>(
        std::vector<std::string>{
            "sh", "-c",
            "exec Xvfb -displayfd 3 -noreset -screen 0 1280x720x24 -nolisten tcp 3>" + number.string()},
        std::vector<std::string>{}, *shared_ / "", *shared_ / "log");
    if (waitUntil([&] { return !readAll(number).empty() || !server_->isRunning(); }))
      display_ = ":" + readAll(number).substr(0, readAll(number).find('\n'));
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
  }

  inline static std::string display_;  // ":1"; empty: none
  inline static std::unique_ptr<Process> server_;
  inline static std::unique_ptr<TemporaryFolder> shared_;
};

}  // namespace nephroid
