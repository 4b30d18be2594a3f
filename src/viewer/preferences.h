// The settings that the viewer stores for each user when it is closed.
#pragma once

#include <filesystem>

#include "core/shared_language.h"

namespace nephroid {

struct ViewerPreferences {
  uvec2 windowSize{1280, 720};  // units of the desktop
  bool arePanelsShown = true;
  bool areTimesShown = true;
};

// nephroid/viewer.toml in XDG_CONFIG_HOME or in ~/.config; empty where neither is known.
std::filesystem::path preferencesFile();

// Reads the preferences. Values that cannot be read have their defaults.
ViewerPreferences loadPreferences(const std::filesystem::path& file);
// Writes the preferences. Errors are ignored.
void savePreferences(const std::filesystem::path& file, const ViewerPreferences& preferences);

}  // namespace nephroid
