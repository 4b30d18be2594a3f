#pragma once

#include "viewer_state.h"

namespace nephroid {

// Which technique, and all that may be said of how it works: the command line's flags.
void drawSettingsPanel(ViewerState& state);

}  // namespace nephroid
