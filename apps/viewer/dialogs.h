// The help page and the questions, which are drawn over all other panels.
#pragma once

#include "key_bindings.h"
#include "viewer_state.h"

namespace nephroid {

void drawDialogs(ViewerState& state, std::span<const KeyBinding> keys, vec2 windowSize, float scale);

}  // namespace nephroid
