#include "view_panels.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>

#include "report/false_color.h"
#include "shown_views.h"
#include "widgets.h"

namespace nephroid {
namespace {

void drawOverlayBoxes(ViewerState& state) {
  constexpr struct {
    const char* name;
    const char* help;
  } kOverlayNames[kOverlays]{
      {"Beams",
       "The corner rays of beams, from glass to the surface that they meet; of adaptive-beams the mesh of "
       "rays, in the colors of how often it was cut (1)"},
      {"Planes", "Virtual planes, with their inner and outer windows (2)"},
      {"Slices", "Planes at which receivers behind glass are looked for (3)"},
      {"Cells", "The cells of irradiance volumes (4)"},
      {"Culled beams",
       "Light that leaves no caster: red is totally reflected until it is lost, blue is held up on "
       "its way (5)"},
  };
  for (std::size_t i = 0; i < kOverlays; ++i) {
    if (i % 3 != 0) ImGui::SameLine((i % 3 == 1 ? 6.5f : 13) * ImGui::GetFontSize());
    ImGui::Checkbox(kOverlayNames[i].name, &state.overlays[i]);
    tooltip(kOverlayNames[i].help);
  }
}

void drawLevelsBox(ViewerState& state) {
  const NamedView levels = viewNamed("levels");
  bool isShown = state.shown == Shown::output && state.shownPass == levels.pass;
  ImGui::BeginDisabled(!outputOf(state, levels.pass, levels.output));
  if (ImGui::Checkbox("Levels", &isShown)) {
    state.shown = Shown::picture;
    if (isShown) showView(levels, state);
  }
  ImGui::EndDisabled();
  tooltip("Receivers in the colors of the cells of landed light that they read (C)");
}

// The next of the pass's outputs, and after the last the picture again.
void showNext(ViewerState& state, const std::string& pass) {
  std::vector<std::string> names;
  for (const PassOutput& output : state.outputs)
    if (output.pass == pass && std::ranges::count(names, output.name) == 0) names.push_back(output.name);
  const bool isThis = state.shown == Shown::output && state.shownPass == pass;
  const auto now = std::ranges::find(names, state.shownOutput);
  const std::size_t next = !isThis              ? 0
                           : now == names.end() ? 1
                                                : static_cast<std::size_t>(now - names.begin()) + 1;
  state.shown = next < names.size() ? Shown::output : Shown::picture;
  if (next >= names.size()) return;
  state.shownPass = pass;
  state.shownOutput = names[next];
}

void drawPass(ViewerState& state, const PassTime& pass, float scale) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  const bool isShown = state.shown == Shown::output && state.shownPass == pass.name;
  if (outputOf(state, pass.name, "")) {
    if (ImGui::Selectable(pass.name.c_str(), isShown)) showNext(state, pass.name);
    tooltip("Click to see what it leaves behind");
  } else {
    ImGui::TextUnformatted(pass.name.c_str());
  }
  ImGui::TableNextColumn();
  textAtRight(formatted("%.2f ms", pass.milliseconds), 72 * scale);
}

void drawCount(const std::string& name, const std::string& value, float scale) {
  ImGui::TableNextRow();
  ImGui::TableNextColumn();
  ImGui::TextDisabled("%s", name.c_str());
  ImGui::TableNextColumn();
  textAtRight(value, 72 * scale);
}

ImU32 colorOf(SrgbColor color) {
  return IM_COL32(color[0], color[1], color[2], 255);
}

void drawErrorScale(double end) {
  const float width = 16 * ImGui::GetFontSize(), height = 0.7f * ImGui::GetFontSize();
  const ImVec2 corner = ImGui::GetCursorScreenPos();
  constexpr int kSteps = 40;
  for (int i = 0; i < kSteps; ++i) {
    const float value = (2 * (static_cast<float>(i) + 0.5f) / kSteps) - 1;
    const float left = corner.x + width * static_cast<float>(i) / kSteps;
    ImGui::GetWindowDrawList()->AddRectFilled(
        {left, corner.y}, {left + width / kSteps + 1, corner.y + height}, colorOf(signedColor(value)));
  }
  ImGui::Dummy({width, height});
  const std::string low = formatted("-%.0f %%", 100 * end), high = formatted("+%.0f %%", 100 * end);
  ImGui::TextUnformatted(low.c_str());
  ImGui::SameLine(0.5f * width - ImGui::GetFontSize());
  ImGui::TextUnformatted("right");
  ImGui::SameLine(width - ImGui::CalcTextSize(high.c_str()).x + ImGui::GetStyle().WindowPadding.x);
  ImGui::TextUnformatted(high.c_str());
}

void drawError(const ViewerState& state) {
  ImGui::TextUnformatted("Error against the reference");
  if (!state.reference || !state.reference->error) {
    ImGui::TextDisabled("The reference is begun when the picture is at rest");
    return;
  }
  const ErrorView& error = *state.reference->error;
  drawErrorScale(error.scaleEnd);
  const auto line = [](const char* name, const LayerErrors& errors) {
    ImGui::Text("%s: %.1f %% in the mean, flux %.3f", name, 100 * errors.mape, errors.fluxRatio);
    ImGui::TextDisabled("   %.1f %% RMS, noise %.1f %%", 100 * errors.relativeRmse,
                        100 * errors.noiseFloor.value_or(0));
  };
  line("All", error.total);
  if (error.caustics.referenceMean > 0) line("Caustics", error.caustics);
}

void drawReference(const ViewerState& state) {
  if (!state.reference)
    ImGui::TextDisabled("Reference: begun when the picture is at rest");
  else if (!std::isfinite(state.reference->noise))
    ImGui::Text("Reference: 1 pass");
  else
    ImGui::Text("Reference: %u passes, caustics within %.1f %%", state.reference->passes,
                100 * state.reference->noise);
}

void drawCulled(const BeamCounts& counts) {
  const auto percent = [&](std::size_t count) {
    return 100 * double(count) /
           double(std::max<std::size_t>(counts.carried + counts.occluded + counts.lost, 1));
  };
  ImGui::Text("Rays at lit vertices: %.1f %% carry light", percent(counts.carried));
  ImGui::TextColored({kLostColor.x, kLostColor.y, kLostColor.z, 1}, "%.1f %% totally reflected until lost",
                     percent(counts.lost));
  ImGui::TextColored({kOccludedColor.x, kOccludedColor.y, kOccludedColor.z, 1}, "%.1f %% held up before",
                     percent(counts.occluded));
}

void drawColors(const Legend& legend, float scale) {
  ImGui::TextUnformatted(legend.title.c_str());
  if (!ImGui::BeginTable("colors", 3, ImGuiTableFlags_SizingFixedFit)) return;
  const float side = ImGui::GetFontSize();
  for (const Legend::Entry& entry : legend.entries) {
    ImGui::TableNextRow();
    ImGui::TableNextColumn();
    const ImVec2 corner = ImGui::GetCursorScreenPos();
    ImGui::GetWindowDrawList()->AddRectFilled(
        corner, {corner.x + 1.5f * side, corner.y + side},
        ImGui::ColorConvertFloat4ToU32({entry.color.x, entry.color.y, entry.color.z, 1}));
    ImGui::Dummy({1.5f * side, side});
    ImGui::TableNextColumn();
    ImGui::TextUnformatted(entry.meaning.c_str());
    ImGui::TableNextColumn();
    textAtRight(std::to_string(entry.count) + " " + legend.counted, 96 * scale);
  }
  ImGui::EndTable();
}

}  // namespace

void drawViewPanel(ViewerState& state) {
  if (!ImGui::CollapsingHeader("View")) return;
  drawOverlayBoxes(state);
  bool isError = state.shown == Shown::error;
  if (ImGui::Checkbox("Error", &isError)) state.shown = isError ? Shown::error : Shown::picture;
  tooltip("False colors of the relative error against the reference, and its number (E)");
  ImGui::SameLine(6.5f * ImGui::GetFontSize());
  drawLevelsBox(state);
  ImGui::SameLine(13 * ImGui::GetFontSize());
  ImGui::Checkbox("Times", &state.areTimesShown);
  tooltip("What the frame's passes take (T)");
  int divisor = static_cast<int>(state.divisor);
  if (ImGui::SliderInt("Coarseness", &divisor, 1, 4, "%d", ImGuiSliderFlags_AlwaysClamp))
    state.divisor = static_cast<uint32_t>(divisor);
  tooltip("Pixels of the window along a pixel of the picture (R)");
}

void drawTimePanel(ViewerState& state, float& seconds) {
  if (!ImGui::CollapsingHeader("Time")) return;
  if (ImGui::Button(state.isPlaying ? "Pause" : "Play")) state.isPlaying = !state.isPlaying;
  tooltip("Waves and lights' cues (K); L and J step by a 60th of a second");
  ImGui::SameLine();
  ImGui::DragFloat("Time", &seconds, 0.02f, 0, 1e6f, "%.2f s");
  tooltip("What moves by itself is shown as it is at this time (s)");
}

void drawTimes(ViewerState& state, const Area& picture, float scale) {
  ImGui::SetNextWindowPos({picture.corner.x + picture.size.x - 8 * scale, picture.corner.y + 8 * scale}, 0,
                          {1, 0});
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("times", nullptr, kOverPicture);
  ImGui::Text("%.1f ms", state.times.milliseconds());
  ImGui::SameLine();
  ImGui::TextDisabled("%.1f frames/s", state.framesPerSecond);
  if (state.gathered > 0)
    ImGui::Text("%u of %u samples", state.gathered, state.settings.samples.count);
  else
    ImGui::TextUnformatted("1 sample, edges smoothed");
  if (ImGui::BeginTable("passes", 2, ImGuiTableFlags_SizingFixedFit)) {
    for (const PassTime& pass : state.times.passes()) drawPass(state, pass, scale);
    for (const auto& [name, count] : state.stats.counts) {
      std::string words = name;
      std::ranges::replace(words, '_', ' ');
      drawCount(words, std::to_string(count), scale);
    }
    drawCount("device memory", formatted("%.1f MB", double(state.memoryBytes) * 1e-6), scale);
    ImGui::EndTable();
  }
  ImGui::End();
}

void drawLegend(const ViewerState& state, const Area& picture, float scale) {
  const bool isError = !state.isReferenceHeld && state.shown == Shown::error;
  const bool isOutput = !state.isReferenceHeld && state.shown == Shown::output;
  const bool isCulled = state.isOverlaid(Overlay::culled);
  const bool isMesh = !state.meshLegend.entries.empty();
  if (!state.isReferenceHeld && !isError && !isOutput && !isCulled && !isMesh && state.recording.empty())
    return;
  ImGui::SetNextWindowPos({picture.corner.x + 8 * scale, picture.corner.y + 8 * scale});
  ImGui::SetNextWindowBgAlpha(0.75f);
  ImGui::Begin("legend", nullptr, kOverPicture);
  if (state.isReferenceHeld || isError) drawReference(state);
  if (isError) drawError(state);
  if (isOutput && !state.outputLegend.entries.empty())
    drawColors(state.outputLegend, scale);
  else if (isOutput)
    ImGui::Text("%s: %s", state.shownPass.c_str(), state.shownOutput.c_str());
  if (isMesh) drawColors(state.meshLegend, scale);
  if (isCulled) drawCulled(state.beamCounts);
  if (!state.recording.empty()) ImGui::TextColored({1, 0.4f, 0.4f, 1}, "Recording (V ends it)");
  ImGui::End();
}

}  // namespace nephroid
