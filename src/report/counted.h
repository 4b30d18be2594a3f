// Numbers of things in messages.
#pragma once

#include <cstddef>
#include <string>

namespace nephroid {

// "1 edge", "3 edges".
inline std::string counted(std::size_t n, const char* singular, const char* plural) {
  return std::to_string(n) + " " + (n == 1 ? singular : plural);
}

}  // namespace nephroid
