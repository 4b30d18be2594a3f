#include "render/settings.h"

#include <utility>

namespace nephroid {
namespace {

std::vector<SettingsView> withFrame(std::vector<SettingsView> views, PictureSettings& settings) {
  views.push_back({"Samples", sampleSettings(), &settings.samples});
  views.push_back({"Sight", sightSettings(), &settings.sight});
  views.push_back({"Air", shaftSettings(), &settings.shafts});
  return views;
}

}  // namespace

void applyTo(Camera& camera, const ToneChoice& choice) {
  if (choice.isExposureChosen) camera.exposure = choice.exposure;
  if (choice.tone) camera.tone = *choice.tone;
}

RenderSettings renderSettings(const PictureSettings& settings, uvec2 size) {
  RenderSettings render;
  render.size = size;
  render.samples = settings.samples.count;
  render.sight = settings.sight;
  render.shafts = settings.shafts;
  return render;
}

void describeSettings(PictureSettings settings, Stats& stats) {
  stats.technique = settings.technique.technique;
  stats.source = nameOf(settings.technique.transport.source);
  stats.settings.clear();
  for (const SettingsView& view : usedSettings(settings))
    for (auto& text : textsOf(view)) stats.settings.push_back(std::move(text));
}

std::vector<SettingsView> allSettings(PictureSettings& settings) {
  return withFrame(allSettings(settings.technique), settings);
}

std::vector<SettingsView> usedSettings(PictureSettings& settings) {
  return withFrame(usedSettings(settings.technique), settings);
}

}  // namespace nephroid
