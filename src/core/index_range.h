// The range of indices that oneapi::tbb::parallel_for splits among threads.
#pragma once

#include <oneapi/tbb/blocked_range.h>

#include <cstddef>

namespace nephroid {

using IndexRange = oneapi::tbb::blocked_range<std::size_t>;

}  // namespace nephroid
