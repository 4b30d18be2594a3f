#include "panels.h"

#include <imgui.h>

#include "scene_panels.h"
#include "settings_panel.h"
#include "view_panels.h"

namespace nephroid {
namespace {

void drawSidePanel(ViewerState& state, const Area& area, float scale, float& seconds) {
  ImGui::SetNextWindowPos({area.corner.x, area.corner.y});
  ImGui::SetNextWindowSize({area.size.x, area.size.y});
  ImGui::Begin("panel", nullptr, kFixed);
  ImGui::PushItemWidth(-130 * scale);
  drawScenePanel(state);
  if (state.isOpen) {
    drawSettingsPanel(state);
    drawLightsPanel(state);
    drawObjectsPanel(state);
    drawMaterialsPanel(state);
    drawAirPanel(state);
    drawCameraPanel(state);
    drawTimePanel(state, seconds);
    drawViewPanel(state);
  }
  ImGui::PopItemWidth();
  ImGui::End();
}

// Along the lower edge of the picture: what goes on, and what there is to say.
void drawStatus(ViewerState& state, const Area& picture, float scale) {
  const bool isTold = std::chrono::steady_clock::now() < state.message.until;
  if (!state.preparing && !isTold) return;
  ImGui::SetNextWindowPos({picture.corner.x + 8 * scale, picture.corner.y + picture.size.y - 8 * scale}, 0,
                          {0, 1});
  ImGui::SetNextWindowSizeConstraints({200 * scale, 0}, {picture.size.x - 16 * scale, 1e4f});
  ImGui::SetNextWindowBgAlpha(0.85f);
  ImGui::Begin("status", nullptr, kOverPicture);
  if (state.preparing) {
    ImGui::ProgressBar(static_cast<float>(state.preparing->fraction), {220 * scale, 0});
    ImGui::SameLine();
    ImGui::TextUnformatted(state.preparing->name.c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) state.isPreparationCanceled = true;
  }
  if (isTold) {
    ImGui::PushTextWrapPos(picture.size.x - 32 * scale);
    if (state.message.isError)
      ImGui::TextColored({1, 0.55f, 0.45f, 1}, "%s", state.message.text.c_str());
    else
      ImGui::TextUnformatted(state.message.text.c_str());
    ImGui::PopTextWrapPos();
  }
  ImGui::End();
}

}  // namespace

Area pictureArea(const ViewerState& state, vec2 windowSize, float scale) {
  const float panel = state.arePanelsShown ? std::min(kPanelWidth * scale, 0.8f * windowSize.x) : 0;
  return {{panel, 0}, {windowSize.x - panel, windowSize.y}};
}

void drawPanels(ViewerState& state, vec2 windowSize, float scale, float& seconds) {
  const Area picture = pictureArea(state, windowSize, scale);
  if (state.arePanelsShown) drawSidePanel(state, {{0, 0}, {picture.corner.x, windowSize.y}}, scale, seconds);
  if (state.areTimesShown && state.isOpen) drawTimes(state, picture, scale);
  if (state.isOpen) drawLegend(state, picture, scale);
  drawStatus(state, picture, scale);
}

}  // namespace nephroid
