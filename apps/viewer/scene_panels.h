// What is in the scene: a heading each.
#pragma once

#include "viewer_state.h"

namespace nephroid {

void drawScenePanel(ViewerState& state);
void drawLightsPanel(ViewerState& state);
void drawObjectsPanel(ViewerState& state);
void drawMaterialsPanel(ViewerState& state);
void drawAirPanel(ViewerState& state);
void drawCameraPanel(ViewerState& state);

}  // namespace nephroid
