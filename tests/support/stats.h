// Numbers that a frame's stats tell.
#pragma once

#include <algorithm>
#include <string>

#include "core/stats.h"

namespace nephroid {

// 0 where it is not told.
inline uint64_t countIn(const Stats& stats, const std::string& name) {
  const auto found = std::ranges::find(stats.counts, name, [](const auto& count) { return count.first; });
  return found == stats.counts.end() ? 0 : found->second;
}

}  // namespace nephroid
