// Charts with curves, as SVG.
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
  Curve left, right;  // two curves, each with its own y axis, which begins at 0
};

// One SVG with the charts side by side.
std::string chartsSvg(const std::vector<Chart>& charts);

}  // namespace nephroid
