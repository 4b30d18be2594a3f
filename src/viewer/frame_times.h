// The frame times for display, smoothed so that they can be read.
#pragma once

#include <vector>

#include "core/stats.h"

namespace nephroid {

class FrameTimes {
 public:
  // Adds a frame: its whole time, and the times of its passes in the order in which they ran.
  void add(double milliseconds, const std::vector<PassTime>& passes);

  // Moving means over the last frames.
  double milliseconds() const { return milliseconds_; }
  const std::vector<PassTime>& passes() const { return passes_; }

 private:
  double milliseconds_ = 0;
  std::vector<PassTime> passes_;
};

}  // namespace nephroid
