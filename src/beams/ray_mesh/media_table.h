// The media that paths are in, by number, so that a path keeps two bytes of them.
#pragma once

#include <cstdint>
#include <span>
#include <unordered_map>
#include <vector>

#include "trace/media.h"

namespace nephroid {

class MediaTable {
 public:
  explicit MediaTable(const RayScene& rayScene) : rays_(rayScene) {}

  uint16_t numberOf(const MediumStack& stack);
  uint32_t top(uint16_t medium) const { return tops_[medium]; }

  // What a path is in before a boundary of `object`, and of what lies in the same place, and beyond it.
  struct Sides {
    uint16_t before = 0;
    uint16_t beyond = 0;
  };
  Sides sidesOf(uint16_t medium, uint32_t object, bool entering);
  Sides sidesOf(uint16_t medium, uint32_t object, bool entering, std::span<const Touching> touching);

 private:
  const RayScene& rays_;
  std::vector<MediumStack> stacks_;
  std::vector<uint32_t> tops_;
  std::unordered_map<uint64_t, Sides> known_;
  uint64_t lastKey_ = ~uint64_t{0};
  Sides last_;
};

}  // namespace nephroid
