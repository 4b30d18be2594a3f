// The panels beside and over the picture.
#pragma once

#include "viewer_state.h"

namespace nephroid {

// A rectangle of the window, in units of the panels.
struct Area {
  vec2 corner{0};
  vec2 size{0};
};

// Unscaled.
inline constexpr float kPanelWidth = 330;

// What is left of a window of this size for the picture.
Area pictureArea(const ViewerState& state, vec2 windowSize, float scale);

void drawPanels(ViewerState& state, vec2 windowSize, float scale);

}  // namespace nephroid
