// What a long step shows of itself: a bar with the time left, on standard error. It is also where Ctrl-C, or
// the step being cancelled, is noticed.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace nephroid {

// One is passed by reference to whatever takes long. Default-made it shows nothing.
class Progress {
 public:
  enum class Display { none, bar };

  Progress() = default;
  explicit Progress(Display display) : isShown_(display == Display::bar) {}
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // A step of `total` equal parts starts, in place of the one before. `name` is what a user reads: "light
  // transport table".
  void begin(std::string name, uint64_t total);
  // `count` more parts are done. From any thread. Throws Interrupted after Ctrl-C or `cancel`.
  void advance(uint64_t count = 1);
  // `done` of the parts are done, and the step has another name. Leaves Ctrl-C to the caller.
  void show(std::string name, uint64_t done);
  // The step is over: its bar is wiped.
  void finish();

  // How far the step is, for who looks on from another thread.
  struct State {
    std::string name;  // empty before the first step
    double fraction = 0;
  };
  State state() const;
  // From any thread, once and for all: the work is unwound as by Ctrl-C.
  void cancel() { isCancelled_ = true; }
  bool isCancelled() const { return isCancelled_; }

 private:
  using Clock = std::chrono::steady_clock;
  void throwIfEnded() const;
  void draw(uint64_t done, Clock::time_point now);

  bool isShown_ = false;
  bool isDrawn_ = false;
  std::atomic<bool> isCancelled_{false};
  mutable std::mutex naming_;  // of the name and the total
  std::string name_;
  uint64_t total_ = 0;
  std::atomic<uint64_t> done_{0};
  Clock::time_point start_;
  Clock::time_point lastDrawn_;
  std::mutex drawing_;
};

// A bar where standard error is a terminal and the user did not ask for quiet.
Progress::Display progressDisplay(bool isQuiet);

// "45 s", "3 min 20 s", "2 h 05 min".
std::string describeDuration(double seconds);

}  // namespace nephroid
