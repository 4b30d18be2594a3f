// The technique and all settings for caustics that a user may choose.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "beams/settings.h"
#include "core/accuracy.h"
#include "core/settings.h"
#include "transport/settings.h"

namespace nephroid {

// The default technique: the name of the first one in the registry.
const char* defaultTechnique();

struct TechniqueSettings {
  std::string technique = defaultTechnique();
  TransportSettings transport;
  BeamDivision beams;
  OwnSettings own;  // the settings of each technique
  std::filesystem::path
      baked;  // the file that `nephroid bake` wrote for the technique; empty: the cache is used
  bool operator==(const TechniqueSettings&) const = default;
};

inline const Accuracy& accuracyOf(const TechniqueSettings& settings) {
  return settings.own.of<Accuracy>();
}

// All settings: of transport and beams, then of every technique. A struct that several techniques share is
// listed once.
std::vector<SettingsView> allSettings(TechniqueSettings& settings);

// The settings that the chosen technique uses.
std::vector<SettingsView> usedSettings(TechniqueSettings& settings);

// The transport settings for the chosen technique. A baked file holds transport tables, unless the technique
// has its own kind of file.
TransportSettings transportOf(const TechniqueSettings& settings);

}  // namespace nephroid
