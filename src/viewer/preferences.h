// What the viewer remembers of how it was left, for each user.
#pragma once

#include <filesystem>

#include "core/shared_language.h"

namespace nephroid {

struct ViewerPreferences {
  uvec2 windowSize{1280, 720};  // units of the desktop
  bool arePanelsShown = true;
  bool areTimesShown = true;
};

// nephroid/viewer.toml in XDG_CONFIG_HOME, or in ~/.config; empty where there is neither.
std::filesystem::path preferencesFile();

// Those that were kept; what cannot be read is as it is at first.
ViewerPreferences loadPreferences(const std::filesystem::path& file);
// Where it cannot be written, nothing is.
void savePreferences(const std::filesystem::path& file, const ViewerPreferences& preferences);

}  // namespace nephroid
