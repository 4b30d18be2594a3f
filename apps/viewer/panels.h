// The panels beside and over the picture.
#pragma once

#include <imgui.h>

#include "viewer_state.h"

namespace nephroid {

// Windows that stay where they are put.
inline constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                           ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings |
                                           ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;
inline constexpr ImGuiWindowFlags kOverPicture =
    kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing;

// A rectangle of the window, in units of the panels.
struct Area {
  vec2 corner{0};
  vec2 size{0};
};

// Unscaled.
inline constexpr float kPanelWidth = 330;

// What is left of a window of this size for the picture.
Area pictureArea(const ViewerState& state, vec2 windowSize, float scale);

// `seconds`: the scene's time, which may be changed.
void drawPanels(ViewerState& state, vec2 windowSize, float scale, float& seconds);

}  // namespace nephroid
