// Which ways light is followed.
#pragma once

#include <array>

namespace nephroid {

// transmission: refraction alone; light that would be totally reflected is lost. all: reflection outside and
// inside as well.
enum class Paths { transmission, all };

// What users call them.
inline constexpr std::array<const char*, 2> kPathsNames{"transmission", "all"};
constexpr const auto& namesOf(Paths) {
  return kPathsNames;
}

}  // namespace nephroid
