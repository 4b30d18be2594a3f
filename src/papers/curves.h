// Curves over a common axis, as a picture.
#pragma once

#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

struct Curve {
  std::string name;          // with its unit
  std::vector<vec2> points;  // x ascending
};

struct Chart {
  std::string title;
  std::string xName;
  Curve left, right;  // each against an axis of its own, both from 0
};

// Side by side, as SVG.
std::string chartsSvg(const std::vector<Chart>& charts);

}  // namespace nephroid
