// The panels beside and over the picture.
#pragma once

#include <imgui.h>

#include "viewer_state.h"

namespace nephroid {

// Flags of panels that the user cannot move.
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

// In units of the panels at scale 1.
inline constexpr float kPanelWidth = 330;

// The part of the window that the panels leave for the picture. `windowSize`: units of the panels.
Area pictureArea(const ViewerState& state, vec2 windowSize, float scale);

// `seconds`: the scene's time, which the user may change in a panel.
void drawPanels(ViewerState& state, vec2 windowSize, float scale, float& seconds);

}  // namespace nephroid
