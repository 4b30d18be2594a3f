#include "core/progress.h"

#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "core/error.h"
#include "core/interrupt.h"

namespace nephroid {
namespace {

constexpr std::chrono::milliseconds kBetweenDraws{100};
constexpr std::chrono::milliseconds kBeforeFirstDraw{400};  // short steps leave the terminal alone
constexpr int kBarWidth = 30;                               // characters

}  // namespace

Progress::Display progressDisplay(bool isQuiet) {
  return !isQuiet && isatty(STDERR_FILENO) ? Progress::Display::bar : Progress::Display::none;
}

std::string describeDuration(double seconds) {
  const auto whole = static_cast<long long>(std::ceil(std::max(seconds, 0.0)));
  char text[64];
  if (whole < 60)
    std::snprintf(text, sizeof text, "%lld s", whole);
  else if (whole < 3600)
    std::snprintf(text, sizeof text, "%lld min %02lld s", whole / 60, whole % 60);
  else
    std::snprintf(text, sizeof text, "%lld h %02lld min", whole / 3600, whole % 3600 / 60);
  return text;
}

void Progress::throwIfEnded() const {
  throwIfInterrupted();
  if (isCanceled_) throw Interrupted();
}

Progress::State Progress::state() const {
  const std::lock_guard lock(naming_);
  return {name_, total_ ? std::min(1.0, double(done_) / double(total_)) : 0.0};
}

void Progress::begin(std::string name, uint64_t total) {
  finish();
  throwIfEnded();
  {
    const std::lock_guard lock(naming_);
    name_ = std::move(name);
    total_ = total;
    done_ = 0;
  }
  start_ = Clock::now();
  lastDrawn_ = start_ + kBeforeFirstDraw - kBetweenDraws;
}

void Progress::advance(uint64_t count) {
  throwIfEnded();
  const uint64_t done = done_ += count;
  if (!isShown_) return;
  const std::unique_lock lock(drawing_, std::try_to_lock);
  const Clock::time_point now = Clock::now();
  if (lock && now - lastDrawn_ >= kBetweenDraws) draw(done, now);
}

void Progress::show(std::string name, uint64_t done) {
  {
    const std::lock_guard lock(naming_);
    name_ = std::move(name);
    done_ = done;
  }
  const Clock::time_point now = Clock::now();
  if (isShown_ && now - lastDrawn_ >= kBetweenDraws) draw(done, now);
}

void Progress::draw(uint64_t done, Clock::time_point now) {
  const double fraction = total_ ? std::min(1.0, double(done) / double(total_)) : 1.0;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left =
      fraction > 0 ? describeDuration(elapsed * (1 - fraction) / fraction) + " left" : "starting";
  const int filled = static_cast<int>(fraction * kBarWidth);
  const std::string bar = std::string(filled, '#') + std::string(kBarWidth - filled, '.');
  std::fprintf(stderr, "\r%-24s [%s] %3.0f %%  %s\x1b[K", name_.c_str(), bar.c_str(), 100 * fraction,
               left.c_str());
  std::fflush(stderr);
  lastDrawn_ = now;
  isDrawn_ = true;
}

void Progress::finish() {
  if (!isDrawn_) return;
  std::fputs("\r\x1b[K", stderr);
  std::fflush(stderr);
  isDrawn_ = false;
}

}  // namespace nephroid
