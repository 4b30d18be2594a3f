#include "panels.h"

#include <imgui.h>

#include "scene_panels.h"
#include "settings_panel.h"
#include "widgets.h"

namespace nephroid {
namespace {

constexpr ImGuiWindowFlags kFixed = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                    ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoSavedSettings |
                                    ImGuiWindowFlags_NoBringToFrontOnFocus | ImGuiWindowFlags_NoNav;

void drawSidePanel(ViewerState& state, const Area& area, float scale) {
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
  }
  ImGui::PopItemWidth();
  ImGui::End();
}

// Over the upper right corner of the picture.
void drawTimes(const ViewerState& state, const Area& picture, float scale) {
  ImGui::SetNextWindowPos({picture.corner.x + picture.size.x - 8 * scale, picture.corner.y + 8 * scale}, 0,
                          {1, 0});
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("times", nullptr,
               kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::Text("%.1f ms", state.times.milliseconds());
  ImGui::SameLine();
  ImGui::TextDisabled("%.1f frames/s", state.shownPerSecond);
  if (ImGui::BeginTable("passes", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const PassTime& pass : state.times.passes()) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextUnformatted(pass.name.c_str());
      ImGui::TableNextColumn();
      textAtRight(formatted("%8.2f ms", pass.milliseconds), 72 * scale);
    }
    for (const auto& [name, count] : state.stats.counts) {
      ImGui::TableNextRow();
      ImGui::TableNextColumn();
      ImGui::TextDisabled("%s", name.c_str());
      ImGui::TableNextColumn();
      textAtRight(formatted("%.0f", double(count)), 72 * scale);
    }
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    ImGui::TextDisabled("device memory");
    ImGui::TableNextColumn();
    textAtRight(formatted("%.1f MB", double(state.memoryBytes) * 1e-6), 72 * scale);
    ImGui::EndTable();
  }
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
  ImGui::Begin("status", nullptr,
               kFixed | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoFocusOnAppearing);
  if (state.preparing) {
    ImGui::ProgressBar(static_cast<float>(state.preparing->fraction), {220 * scale, 0});
    ImGui::SameLine();
    ImGui::TextUnformatted(state.preparing->name.c_str());
    ImGui::SameLine();
    if (ImGui::SmallButton("Cancel")) state.isPreparationCancelled = true;
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

void drawPanels(ViewerState& state, vec2 windowSize, float scale) {
  const Area picture = pictureArea(state, windowSize, scale);
  if (state.arePanelsShown) drawSidePanel(state, {{0, 0}, {picture.corner.x, windowSize.y}}, scale);
  if (state.areTimesShown && state.isOpen) drawTimes(state, picture, scale);
  drawStatus(state, picture, scale);
}

}  // namespace nephroid
