#include "reference/refine.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>

#include "core/interrupt.h"

namespace nephroid {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double kFirstKept = 10;   // s until what there is is kept for the first time
constexpr double kBetweenKept = 2;  // times as long until the next
constexpr uint64_t kParts = 1000;   // of the progress bar

// How far along, by the rule that will stop first.
double fractionDone(const StopRule& rule, uint32_t passes, double seconds, double noise) {
  double fraction = 0;
  if (rule.passes > 0) fraction = std::max(fraction, double(passes) / rule.passes);
  if (rule.seconds > 0) fraction = std::max(fraction, seconds / rule.seconds);
  if (rule.error > 0) fraction = std::max(fraction, std::pow(rule.error / noise, 2));
  return std::min(fraction, 1.0);
}

bool isDone(const StopRule& rule, uint32_t passes, double seconds, double noise) {
  constexpr uint32_t kFewestPasses = 5;  // before their spread is believed
  return (rule.passes > 0 && passes >= rule.passes) || (rule.seconds > 0 && seconds >= rule.seconds) ||
         (rule.error > 0 && passes >= kFewestPasses && noise <= rule.error);
}

std::string describe(uint32_t passes, double noise) {
  char text[64];
  if (std::isfinite(noise))
    std::snprintf(text, sizeof text, "pass %u, %.2f %% error", passes, 100 * noise);
  else
    std::snprintf(text, sizeof text, "pass %u", passes);
  return text;
}

}  // namespace

bool refine(Estimate& estimate, const StopRule& rule, Progress& progress, const std::function<void()>& keep) {
  const Clock::time_point start = Clock::now();
  double nextKept = kFirstKept;
  double seconds = 0, noise = estimate.noise();
  progress.begin(describe(estimate.passes(), noise), kParts);
  while (!isDone(rule, estimate.passes(), seconds, noise)) {
    if (isInterrupted()) {
      acknowledgeInterrupt();
      progress.finish();
      return false;
    }
    estimate.pass();
    seconds = std::chrono::duration<double>(Clock::now() - start).count();
    noise = estimate.noise();
    const double fraction = fractionDone(rule, estimate.passes(), seconds, noise);
    progress.show(describe(estimate.passes(), noise), uint64_t(fraction * kParts));
    if (!keep || seconds < nextKept) continue;
    keep();
    nextKept = seconds * kBetweenKept;
  }
  progress.finish();
  return true;
}

}  // namespace nephroid
