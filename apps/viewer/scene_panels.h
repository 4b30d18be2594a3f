// The panels that show and change a scene, one for each kind of thing in it.
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
