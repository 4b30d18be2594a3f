// The progress of a long step: a bar with the time left, on standard error. Ctrl-C and cancellation are also
// noticed here.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <mutex>
#include <string>

namespace nephroid {

// Functions that take long get one by reference. A default-constructed Progress shows nothing.
class Progress {
 public:
  enum class Display { none, bar };

  Progress() = default;
  explicit Progress(Display display) : isShown_(display == Display::bar) {}
  ~Progress() { finish(); }
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Starts a step of `total` equal parts and ends the one before. `name` is shown to the user: "light
  // transport table".
  void begin(std::string name, uint64_t total);
  // Counts `count` more parts as done. Any thread may call it. Throws Interrupted after Ctrl-C or `cancel`.
  void advance(uint64_t count = 1);
  // Sets the number of parts done, and a new name for the step. Does not check for Ctrl-C.
  void show(std::string name, uint64_t done);
  // Ends the step and removes its bar.
  void finish();

  // The progress of the step, for another thread to show.
  struct State {
    std::string name;  // empty before the first step
    double fraction = 0;
  };
  State state() const;
  // Ends the work as Ctrl-C does. Any thread may call it.
  void cancel() { isCanceled_ = true; }
  // Other work may begin after what was canceled has ended.
  void renew() { isCanceled_ = false; }
  bool isCanceled() const { return isCanceled_; }

 private:
  using Clock = std::chrono::steady_clock;
  void throwIfEnded() const;
  void draw(uint64_t done, Clock::time_point now);

  bool isShown_ = false;
  bool isDrawn_ = false;
  std::atomic<bool> isCanceled_{false};
  mutable std::mutex naming_;  // of the name and the total
  std::string name_;
  uint64_t total_ = 0;
  std::atomic<uint64_t> done_{0};
  Clock::time_point start_;
  Clock::time_point lastDrawn_;
  std::mutex drawing_;
};

// A bar where standard error is a terminal and `isQuiet` is false.
Progress::Display progressDisplay(bool isQuiet);

// "45 s", "3 min 20 s", "2 h 05 min".
std::string describeDuration(double seconds);

}  // namespace nephroid
