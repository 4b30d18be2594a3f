#include "viewer/frame_times.h"

#include <algorithm>

namespace nephroid {
namespace {

constexpr double kShareOfNewest = 0.1;

double faded(double before, double now) {
  return before > 0 ? before + kShareOfNewest * (now - before) : now;
}

}  // namespace

void FrameTimes::add(double milliseconds, const std::vector<PassTime>& passes) {
  milliseconds_ = faded(milliseconds_, milliseconds);
  std::vector<PassTime> means = passes;
  for (PassTime& mean : means) {
    const auto before = std::ranges::find(passes_, mean.name, &PassTime::name);
    if (before != passes_.end()) mean.milliseconds = faded(before->milliseconds, mean.milliseconds);
  }
  passes_ = std::move(means);
}

}  // namespace nephroid
