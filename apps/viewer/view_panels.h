// What is shown, what it takes, and when.
#pragma once

#include "panels.h"

namespace nephroid {

void drawViewPanel(ViewerState& state);
void drawTimePanel(ViewerState& state, float& seconds);
// Over the upper right corner of the picture. A click on a pass shows its output.
void drawTimes(ViewerState& state, const Area& picture, float scale);
// Over the upper left one: what is seen in place of the picture, and what its colors say.
void drawLegend(const ViewerState& state, const Area& picture, float scale);

}  // namespace nephroid
