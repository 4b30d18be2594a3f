// Which paths of light are followed.
#pragma once

#include <array>

namespace nephroid {

// transmission: only refraction; light that is totally reflected is lost. all: also reflection outside and
// inside casters.
enum class Paths { transmission, all };

// The users' names, in the same order.
inline constexpr std::array<const char*, 2> kPathsNames{"transmission", "all"};
constexpr const auto& namesOf(Paths) {
  return kPathsNames;
}

}  // namespace nephroid
