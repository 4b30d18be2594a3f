// The panels for what is shown, for the time, and for the frame times.
#pragma once

#include "panels.h"

namespace nephroid {

void drawViewPanel(ViewerState& state);
void drawTimePanel(ViewerState& state, float& seconds);
// Draws the frame times over the upper right corner of the picture. A click on a pass shows its output.
void drawTimes(ViewerState& state, const Area& picture, float scale);
// Draws a legend over the upper left corner: what is shown in place of the picture, and what its colors mean.
void drawLegend(const ViewerState& state, const Area& picture, float scale);

}  // namespace nephroid
