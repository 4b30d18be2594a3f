// Middles of a mesh's sides, found by their ends.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

namespace nephroid {

class EdgeTable {
 public:
  // The place for the side between two corners, which holds `kEmpty` where nothing was put there. Lasts until
  // the next call.
  static constexpr uint32_t kEmpty = ~uint32_t{0};
  uint32_t& at(uint32_t a, uint32_t b) {
    if (2 * (used_ + 1) > slots_.size()) grow();
    const uint64_t key = a < b ? uint64_t(a) << 32 | b : uint64_t(b) << 32 | a;
    Slot& slot = slots_[find(key)];
    if (slot.key == kNoKey) {
      slot.key = key;
      ++used_;
      mayHold_[placeOf(key) / 64 % kWords] |= uint64_t{1} << placeOf(key) % 64;
    }
    return slot.value;
  }
  // kEmpty where there is none.
  uint32_t find(uint32_t a, uint32_t b) const {
    const uint64_t key = a < b ? uint64_t(a) << 32 | b : uint64_t(b) << 32 | a;
    const bool mayHold = !slots_.empty() && (mayHold_[placeOf(key) / 64 % kWords] >> placeOf(key) % 64 & 1u);
    return mayHold ? slots_[find(key)].value : kEmpty;
  }
  // Its memory stays.
  void clear() {
    std::ranges::fill(slots_, Slot{});
    std::ranges::fill(mayHold_, 0);
    used_ = 0;
  }
  std::size_t bytes() const { return slots_.size() * sizeof(Slot) + kWords * sizeof(uint64_t); }

 private:
  static constexpr uint64_t kNoKey = ~uint64_t{0};
  struct Slot {
    uint64_t key = kNoKey;
    uint32_t value = kEmpty;
  };

  static std::size_t placeOf(uint64_t key) { return std::size_t(key * 0x9e3779b97f4a7c15u >> 20); }
  std::size_t find(uint64_t key) const {
    const std::size_t mask = slots_.size() - 1;
    std::size_t i = placeOf(key) & mask;
    while (slots_[i].key != key && slots_[i].key != kNoKey) i = (i + 1) & mask;
    return i;
  }
  void grow() {
    std::vector<Slot> old(slots_.empty() ? 1024 : 2 * slots_.size());
    old.swap(slots_);
    for (const Slot& slot : old)
      if (slot.key != kNoKey) slots_[find(slot.key)] = slot;
  }

  // A bit for many keys, in memory that a processor has near: most sides that are asked for are not here.
  static constexpr std::size_t kWords = 1 << 14;
  std::vector<uint64_t> mayHold_ = std::vector<uint64_t>(kWords, 0);
  std::vector<Slot> slots_;
  std::size_t used_ = 0;
};

}  // namespace nephroid
