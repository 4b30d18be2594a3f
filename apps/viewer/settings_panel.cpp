#include "settings_panel.h"

#include <imgui.h>

#include "techniques/registry.h"
#include "widgets.h"

namespace nephroid {
namespace {

void drawTechnique(TechniqueSettings& settings) {
  if (ImGui::BeginCombo("Technique", settings.technique.c_str())) {
    for (const TechniqueEntry& entry : techniques())
      if (ImGui::Selectable(entry.name, entry.name == settings.technique)) settings.technique = entry.name;
    ImGui::EndCombo();
  }
  tooltip("How caustics are made (M for the next one)");
}

void drawChoice(const ChoiceField& choice, TechniqueSettings& settings) {
  const uint32_t now = choice.get(settings);
  if (ImGui::BeginCombo(spelledOut(choice.flag).c_str(), choice.names[now])) {
    for (uint32_t i = 0; i < choice.names.size(); ++i)
      if (ImGui::Selectable(choice.names[i], i == now)) choice.set(settings, i);
    ImGui::EndCombo();
  }
  tooltip(choice.help);
}

void drawField(const SettingField& field, TechniqueSettings& settings) {
  constexpr uint32_t kWide = 64;
  const bool isWide = field.maximum > kWide * std::max(field.minimum, 1u);
  ImGui::SliderScalar(spelledOut(field.flag).c_str(), ImGuiDataType_U32, &(settings.*field.member),
                      &field.minimum, &field.maximum, "%u",
                      ImGuiSliderFlags_AlwaysClamp | (isWide ? ImGuiSliderFlags_Logarithmic : 0));
  tooltip(field.help);
}

void drawPart(const PartField& field, TechniqueSettings& settings) {
  ImGui::SliderFloat(spelledOut(field.flag).c_str(), &(settings.*field.member), 0, 1, "%.2f",
                     ImGuiSliderFlags_AlwaysClamp);
  tooltip(field.help);
}

}  // namespace

void drawSettingsPanel(ViewerState& state) {
  TechniqueSettings& settings = state.settings;
  drawTechnique(settings);
  drawChoice(choiceFields().front(), settings);  // the source
  if (!ImGui::CollapsingHeader("Technique")) return;
  for (const ChoiceField& choice : choiceFields().subspan(1)) drawChoice(choice, settings);
  for (const SettingField& field : settingFields()) drawField(field, settings);
  for (const PartField& field : partFields()) drawPart(field, settings);
  if (ImGui::Button("Defaults")) {
    const TechniqueSettings before = settings;
    settings = {};
    settings.technique = before.technique;
    settings.baked = before.baked;
  }
}

}  // namespace nephroid
