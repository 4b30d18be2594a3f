#include "dialogs.h"

#include <imgui.h>

namespace nephroid {
namespace {

constexpr ImGuiWindowFlags kDialog = ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                     ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                                     ImGuiWindowFlags_AlwaysAutoResize;

void centerNext(vec2 windowSize) {
  ImGui::SetNextWindowPos({0.5f * windowSize.x, 0.5f * windowSize.y}, ImGuiCond_Always, {0.5f, 0.5f});
}

void drawKey(const KeyBinding& key) {
  ImGui::TableNextColumn();
  ImGui::TextColored({0.55f, 0.82f, 1, 1}, "%s", key.shown);
  ImGui::TableNextColumn();
  ImGui::TextUnformatted(key.help);
}

// In two halves side by side.
void drawHelp(ViewerState& state, std::span<const KeyBinding> keys, vec2 windowSize) {
  std::vector<const KeyBinding*> shown;
  for (const KeyBinding& key : keys)
    if (*key.shown != 0) shown.push_back(&key);
  centerNext(windowSize);
  ImGui::SetNextWindowBgAlpha(0.97f);
  ImGui::SetNextWindowFocus();
  ImGui::Begin("Keys and mouse", &state.isHelpShown, kDialog);
  if (ImGui::BeginTable("keys", 4, ImGuiTableFlags_SizingFixedFit)) {
    const std::size_t half = (shown.size() + 1) / 2;
    for (std::size_t i = 0; i < half; ++i) {
      ImGui::TableNextRow();
      drawKey(*shown[i]);
      if (half + i < shown.size()) drawKey(*shown[half + i]);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

const char* whatFor(Question::About about) {
  switch (about) {
    case Question::About::close:
      return "There are changes that are not saved.";
    case Question::About::open:
      return "Another scene is to be opened, and there are changes that are not saved.";
    case Question::About::reload:
      return "The file was changed meanwhile, and there are changes here that are not saved.";
  }
  return "";
}

void drawQuestion(Question& question, vec2 windowSize, float scale) {
  using Answer = Question::Answer;
  centerNext(windowSize);
  ImGui::SetNextWindowFocus();
  ImGui::Begin("Save the changes?", nullptr, kDialog);
  ImGui::TextUnformatted(whatFor(question.about));
  ImGui::Spacing();
  const ImVec2 size{110 * scale, 0};
  // What would write over the other's changes is not offered.
  if (question.about != Question::About::reload) {
    if (ImGui::Button("Save", size)) question.answer = Answer::save;
    ImGui::SameLine();
  }
  if (ImGui::Button("Do not save", size)) question.answer = Answer::discard;
  ImGui::SameLine();
  if (ImGui::Button(question.about == Question::About::reload ? "Keep mine" : "Cancel", size))
    question.answer = Answer::cancel;
  ImGui::End();
}

}  // namespace

void drawDialogs(ViewerState& state, std::span<const KeyBinding> keys, vec2 windowSize, float scale) {
  if (state.isHelpShown) drawHelp(state, keys, windowSize);
  if (state.question) drawQuestion(*state.question, windowSize, scale);
}

}  // namespace nephroid
