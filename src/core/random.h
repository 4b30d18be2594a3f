// Random numbers that are the same on every machine.
#pragma once

#include <cstdint>

namespace nephroid {

// PCG32 (O'Neill 2014, PCG-XSH-RR): small, and the same numbers on every machine. Streams with different
// `sequence` are independent, so that parallel work can give each item its own.
class Random {
 public:
  explicit Random(uint64_t seed, uint64_t sequence = 0) : increment_(sequence << 1 | 1) {
    next();
    state_ += seed;
    next();
  }

  uint32_t next() {
    const uint64_t old = state_;
    state_ = old * 6364136223846793005ULL + increment_;
    const auto shifted = static_cast<uint32_t>(((old >> 18) ^ old) >> 27);
    const auto rotation = static_cast<uint32_t>(old >> 59);
    return shifted >> rotation | shifted << (-rotation & 31);
  }

  // A number in [0, 1) with 24 random bits.
  float uniform() { return static_cast<float>(next() >> 8) * 0x1p-24f; }

 private:
  uint64_t state_ = 0;
  uint64_t increment_;
};

}  // namespace nephroid
