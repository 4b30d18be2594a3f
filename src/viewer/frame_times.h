// What frames take, as it is shown: steady enough to be read.
#pragma once

#include <vector>

#include "core/stats.h"

namespace nephroid {

class FrameTimes {
 public:
  // A frame that took so long in all, and its passes in the order in which they ran.
  void add(double milliseconds, const std::vector<PassTime>& passes);

  // Means over the last frames, in which old ones fade out.
  double milliseconds() const { return milliseconds_; }
  const std::vector<PassTime>& passes() const { return passes_; }

 private:
  double milliseconds_ = 0;
  std::vector<PassTime> passes_;
};

}  // namespace nephroid
