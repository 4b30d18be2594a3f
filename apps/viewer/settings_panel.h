// The viewer's panel of techniques and their settings.
#pragma once

#include "viewer_state.h"

namespace nephroid {

// Shows the technique and all its settings, which are the same as on the command line.
void drawSettingsPanel(ViewerState& state);

}  // namespace nephroid
