// The index that means "none". Parts of a scene refer to each other by index.
#pragma once

#include <cstdint>
#include <limits>

namespace nephroid {

inline constexpr uint32_t kNone = std::numeric_limits<uint32_t>::max();

}  // namespace nephroid
