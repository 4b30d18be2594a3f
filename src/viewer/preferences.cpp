#include "viewer/preferences.h"

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "core/atomic_file.h"
#include "core/error.h"
#include "formats/scene_toml.h"
#include "formats/toml_table.h"

namespace nephroid {

std::filesystem::path preferencesFile() {
  const char* config = std::getenv("XDG_CONFIG_HOME");
  const char* home = std::getenv("HOME");
  if (config && *config) return std::filesystem::path(config) / "nephroid" / "viewer.toml";
  if (home && *home) return std::filesystem::path(home) / ".config" / "nephroid" / "viewer.toml";
  return {};
}

ViewerPreferences loadPreferences(const std::filesystem::path& file) {
  ViewerPreferences preferences;
  std::error_code error;
  if (file.empty() || !std::filesystem::exists(file, error)) return preferences;
  try {
    const toml::table table = parseToml(readSceneFile(file), file.string());
    const auto side = [&](const char* key, uint32_t byDefault) {
      return static_cast<uint32_t>(std::clamp<int64_t>(table[key].value_or<int64_t>(byDefault), 320, 16384));
    };
    preferences.windowSize = {side("width", preferences.windowSize.x),
                              side("height", preferences.windowSize.y)};
    preferences.arePanelsShown = table["panels"].value_or(preferences.arePanelsShown);
    preferences.areTimesShown = table["times"].value_or(preferences.areTimesShown);
  } catch (const InputError&) {
    return {};
  }
  return preferences;
}

void savePreferences(const std::filesystem::path& file, const ViewerPreferences& preferences) {
  if (file.empty()) return;
  std::ostringstream text;
  text << "width = " << preferences.windowSize.x << "\nheight = " << preferences.windowSize.y
       << std::boolalpha << "\npanels = " << preferences.arePanelsShown
       << "\ntimes = " << preferences.areTimesShown << '\n';
  try {
    std::filesystem::create_directories(file.parent_path());
    writeFileAtomically(file, text.str());
  } catch (const std::exception&) {
    return;  // a window that opens at its first size is no reason to fail
  }
}

}  // namespace nephroid
