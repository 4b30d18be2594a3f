#include "beams/ray_mesh/media_table.h"

#include <algorithm>

namespace nephroid {

uint16_t MediaTable::numberOf(const MediumStack& stack) {
  const auto isSame = [&](const MediumStack& other) {
    return other.size == stack.size &&
           std::equal(stack.objects.begin(), stack.objects.begin() + stack.size, other.objects.begin());
  };
  const auto found = std::ranges::find_if(stacks_, isSame);
  if (found != stacks_.end()) return uint16_t(found - stacks_.begin());
  stacks_.push_back(stack);
  tops_.push_back(stack.top());
  return uint16_t(stacks_.size() - 1);
}

MediaTable::Sides MediaTable::sidesOf(uint16_t medium, uint32_t object, bool entering) {
  const uint64_t key = uint64_t(medium) << 33 | uint64_t(object) << 1 | uint64_t(entering);
  if (key == lastKey_) return last_;
  lastKey_ = key;
  const auto found = known_.find(key);
  if (found != known_.end()) return last_ = found->second;
  last_ = sidesOf(medium, object, entering, {});
  known_.emplace(key, last_);
  return last_;
}

MediaTable::Sides MediaTable::sidesOf(uint16_t medium, uint32_t object, bool entering,
                                      std::span<const Touching> touching) {
  const MediaSides sides = nephroid::sidesOf(rays_, stacks_[medium], object, entering, touching);
  return {numberOf(sides.before), numberOf(sides.beyond)};
}

}  // namespace nephroid
