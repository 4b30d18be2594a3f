// The settings of pictures, apart from those of the technique.
#pragma once

#include <optional>
#include <vector>

#include "core/shared_language.h"
#include "core/stats.h"
#include "render/air/settings.h"
#include "render/samples/settings.h"
#include "render/sight/settings.h"
#include "scene/scene.h"
#include "techniques/settings.h"

namespace nephroid {

struct RenderSettings {
  uvec2 size{640, 480};        // pixels
  uint32_t shadowMapSize = 0;  // texels along a side; 0: as many as pixels along the picture's longer side
  uint32_t samples = 1;        // of each pixel
  SightSettings sight;
  ShaftSettings shafts;
  // Keep shadow maps and beams of the last frame where nothing that they depend on has changed. Without it,
  // each frame does all work that a moved light needs.
  bool keepsLight = false;
};

// All settings of a picture that a user may choose.
struct PictureSettings {
  TechniqueSettings technique;
  SampleSettings samples;
  SightSettings sight;
  ShaftSettings shafts;
  bool operator==(const PictureSettings&) const = default;
};

// What a user chose in place of what the scene's camera says.
struct ToneChoice {
  bool isExposureChosen = false;
  std::optional<float> exposure;  // where it is chosen; none: metered
  std::optional<ToneCurve> tone;
};
void applyTo(Camera& camera, const ToneChoice& choice);

// The render settings for a picture of `size` pixels.
RenderSettings renderSettings(const PictureSettings& settings, uvec2 size);

// Writes the technique, the source and all settings that the technique uses to `stats`, as on the command
// line.
void describeSettings(PictureSettings settings, Stats& stats);

// The settings of all owners: those of all techniques, or only those that the chosen technique uses.
std::vector<SettingsView> allSettings(PictureSettings& settings);
std::vector<SettingsView> usedSettings(PictureSettings& settings);

}  // namespace nephroid
