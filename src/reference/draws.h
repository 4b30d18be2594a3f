// Random numbers for the looks of a pass into a pixel, or for other samples of which there are a few.
#pragma once

#include <algorithm>
#include <cstdint>

#include "reference/sampling.h"

namespace nephroid {

// One of the orders of `count` things, by its number (Kensler 2013, Correlated Multi-Jittered Sampling,
// listing 4): where the thing at `index` goes.
inline uint32_t placeInOrder(uint32_t index, uint32_t count, uint32_t order) {
  uint32_t mask = count - 1;
  for (uint32_t shift = 1; shift < 32; shift *= 2) mask |= mask >> shift;
  do {
    index ^= order;
    index *= 0xe170893d;
    index ^= order >> 16;
    index ^= (index & mask) >> 4;
    index ^= order >> 8;
    index *= 0x0929eb3f;
    index ^= order >> 23;
    index ^= (index & mask) >> 1;
    index *= 1 | order >> 27;
    index *= 0x6935fa69;
    index ^= (index & mask) >> 11;
    index *= 0x74dcb303;
    index ^= (index & mask) >> 2;
    index *= 0x9e501cc3;
    index ^= (index & mask) >> 2;
    index *= 0xc860a3df;
    index &= mask;
    index ^= index >> 5;
  } while (index >= count);
  return (index + order % count) % count;
}

// The numbers of one of `count` samples that are summed up. The first numbers of all the samples are in as
// many equal parts of [0, 1), one in each; so are the second ones, and so on. Which sample has which part is
// random each time, so that each sample by itself is random (Latin hypercubes, McKay et al. 1979).
class Draws {
 public:
  // `random`: for this set of samples, the same for each of them.
  Draws(Random random, uint32_t index, uint32_t count) : random_(random), index_(index), count_(count) {}

  float uniform() {
    const uint32_t order = random_.next(), within = random_.next();
    if (count_ == 1) return float(within >> 8) * 0x1p-24f;
    const uint32_t own = Random(within, index_).next();
    const float part = float(placeInOrder(index_, count_, order)) + float(own >> 8) * 0x1p-24f;
    return std::min(part / float(count_), 1 - 0x1p-24f);
  }

  // Numbers for one of two ways that the sample goes on by, apart from those for the other.
  Draws branch() {
    const uint64_t seed = random_.next();
    return {Random(seed << 32 | random_.next(), seed), index_, count_};
  }

 private:
  Random random_;
  uint32_t index_, count_;
};

}  // namespace nephroid
