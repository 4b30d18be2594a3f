#include "settings_panel.h"

#include <imgui.h>

#include "techniques/registry.h"
#include "viewer.h"
#include "widgets.h"

namespace nephroid {
namespace {

void drawTechnique(TechniqueSettings& settings) {
  if (ImGui::BeginCombo("Technique", settings.technique.c_str())) {
    for (const TechniqueInfo* info : techniques()) {
      if (ImGui::Selectable(info->name, info->name == settings.technique)) settings.technique = info->name;
      tooltip(info->summary);
    }
    ImGui::EndCombo();
  }
  tooltip("How caustics are made (M for the next one)");
}

void drawChoice(const Setting& setting, void* owner) {
  const auto now = static_cast<std::size_t>(setting.get(owner));
  if (!ImGui::BeginCombo(spelledOut(setting.flag).c_str(), setting.names[now])) return;
  for (std::size_t i = 0; i < setting.names.size(); ++i)
    if (ImGui::Selectable(setting.names[i], i == now)) setting.set(owner, static_cast<double>(i));
  ImGui::EndCombo();
}

void drawWhole(const Setting& setting, void* owner) {
  constexpr uint64_t kWide = 64;
  const auto least = static_cast<uint64_t>(setting.least), most = static_cast<uint64_t>(setting.most);
  auto value = static_cast<uint64_t>(setting.get(owner));
  const bool isWide = most > kWide * std::max<uint64_t>(least, 1);
  if (ImGui::SliderScalar(spelledOut(setting.flag).c_str(), ImGuiDataType_U64, &value, &least, &most, "%llu",
                          ImGuiSliderFlags_AlwaysClamp | (isWide ? ImGuiSliderFlags_Logarithmic : 0)))
    setting.set(owner, static_cast<double>(value));
}

void drawReal(const Setting& setting, void* owner) {
  auto value = static_cast<float>(setting.get(owner));
  if (ImGui::SliderFloat(spelledOut(setting.flag).c_str(), &value, static_cast<float>(setting.least),
                         static_cast<float>(setting.most), "%.2f", ImGuiSliderFlags_AlwaysClamp))
    setting.set(owner, static_cast<double>(value));
}

void drawSetting(const Setting& setting, void* owner) {
  switch (setting.kind) {
    case SettingKind::choice:
      drawChoice(setting, owner);
      break;
    case SettingKind::whole:
      drawWhole(setting, owner);
      break;
    default:
      drawReal(setting, owner);
  }
  tooltip(setting.help);
}

}  // namespace

void drawSettingsPanel(ViewerState& state) {
  drawTechnique(state.settings.technique);
  for (const SettingsView& view : usedSettings(state.settings)) {
    if (!ImGui::CollapsingHeader(view.owner)) continue;
    ImGui::PushID(view.owner);
    for (const Setting& setting : view.settings) drawSetting(setting, view.values);
    ImGui::PopID();
  }
  if (ImGui::Button("Defaults")) {
    const TechniqueSettings before = state.settings.technique;
    state.settings = viewerSettings();
    state.settings.technique.technique = before.technique;
    state.settings.technique.baked = before.baked;
  }
}

}  // namespace nephroid
