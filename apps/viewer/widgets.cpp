#include "widgets.h"

#include <imgui.h>

#include <algorithm>
#include <cctype>
#include <cstdio>

namespace nephroid {

std::string formatted(const char* format, double value) {
  char text[64];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

void textAtRight(const std::string& text, float width) {
  ImGui::SetCursorPosX(ImGui::GetCursorPosX() + width - ImGui::CalcTextSize(text.c_str()).x);
  ImGui::TextUnformatted(text.c_str());
}

void tooltip(const std::string& text) {
  if (text.empty() || !ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) return;
  ImGui::BeginTooltip();
  ImGui::PushTextWrapPos(26 * ImGui::GetFontSize());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::EndTooltip();
}

std::string spelledOut(const std::string& name) {
  std::string text = name;
  std::ranges::replace(text, '-', ' ');
  if (!text.empty()) text[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(text[0])));
  return text;
}

bool slider(const char* label, float& value, float low, float high, const char* format, const char* help,
            bool isLogarithmic) {
  const ImGuiSliderFlags flags =
      ImGuiSliderFlags_AlwaysClamp | (isLogarithmic ? ImGuiSliderFlags_Logarithmic : ImGuiSliderFlags_None);
  const bool isChanged = ImGui::SliderFloat(label, &value, low, high, format, flags);
  tooltip(help);
  return isChanged;
}

bool dragMeters(const char* label, vec3& value, const char* help) {
  const bool isChanged = ImGui::DragFloat3(label, &value.x, 0.01f, 0, 0, "%.3g");
  tooltip(help);
  return isChanged;
}

bool color(const char* label, vec3& value, const char* help) {
  const bool isChanged =
      ImGui::ColorEdit3(label, &value.x, ImGuiColorEditFlags_Float | ImGuiColorEditFlags_NoInputs);
  tooltip(help);
  return isChanged;
}

bool colorAndStrength(const char* id, const char* strengthLabel, vec3& value, float most, const char* format,
                      const char* help) {
  ImGui::PushID(id);
  float strength = std::max({value.x, value.y, value.z});
  vec3 tint = strength > 0 ? value / strength : vec3(1);
  bool isChanged = slider(strengthLabel, strength, 0, most, format, help, true);
  ImGui::SameLine();
  isChanged |=
      color("##tint", tint, "Color, linear Rec. 709; the largest channel has the strength beside it");
  if (isChanged) {
    const float brightest = std::max({tint.x, tint.y, tint.z});
    value = brightest > 0 ? strength / brightest * tint : vec3(0);
  }
  ImGui::PopID();
  return isChanged;
}

}  // namespace nephroid
