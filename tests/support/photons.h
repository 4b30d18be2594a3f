// How many photons a test follows.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#ifndef __has_feature
#define __has_feature(x) 0
#endif

namespace nephroid {

#if defined(__SANITIZE_ADDRESS__) || __has_feature(address_sanitizer)
inline constexpr bool kIsSanitized = true;
#else
inline constexpr bool kIsSanitized = false;
#endif

// Under the sanitizers, where each takes several times as long, one photon of so many is followed. They go
// through the same code.
inline constexpr uint32_t kPhotonsForOne = kIsSanitized ? 8 : 1;

constexpr uint32_t photonsOf(uint32_t wanted) {
  return std::max(wanted / kPhotonsForOne, 1u);
}

// A bound on a standard error that `wanted` photons keep within, for as many as are followed: standard errors
// fall with the root of their number.
inline double standardErrorOf(double bound) {
  return bound * std::sqrt(double(kPhotonsForOne));
}

}  // namespace nephroid
