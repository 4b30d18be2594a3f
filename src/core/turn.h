// A full turn, as an angle.
#pragma once

#include <numbers>

namespace nephroid {

inline constexpr double kTurn = 2 * std::numbers::pi;  // radians

}  // namespace nephroid
