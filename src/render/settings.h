// How a scene is drawn, whichever technique draws its caustics.
#pragma once

#include <vector>

#include "core/shared_language.h"
#include "core/stats.h"
#include "render/air/settings.h"
#include "render/sight/settings.h"
#include "techniques/settings.h"

namespace nephroid {

struct RenderSettings {
  uvec2 size{640, 480};        // pixels
  uint32_t shadowMapSize = 0;  // texels along a side; 0: as many as pixels along the picture's longer side
  SightSettings sight;
  ShaftSettings shafts;
  // Shadow maps and beams of the last frame are kept while all that they depend on stands still. Without it
  // each frame does all that a moved light would change.
  bool keepsLight = false;
};

// All that a user may choose about a picture.
struct PictureSettings {
  TechniqueSettings technique;
  SightSettings sight;
  ShaftSettings shafts;
  bool operator==(const PictureSettings&) const = default;
};

// Of `size` pixels.
RenderSettings renderSettings(const PictureSettings& settings, uvec2 size);

// Technique, source and all that the technique uses, as the command line takes them.
void describeSettings(PictureSettings settings, Stats& stats);

// Of every owner: those of all techniques, or those that the chosen one uses.
std::vector<SettingsView> allSettings(PictureSettings& settings);
std::vector<SettingsView> usedSettings(PictureSettings& settings);

}  // namespace nephroid
