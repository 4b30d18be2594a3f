// All that a user may choose about how caustics are made: which technique, and the settings of each owner.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "beams/settings.h"
#include "core/settings.h"
#include "transport/settings.h"

namespace nephroid {

// The name of the technique that is used where none is named: the first of the registry.
const char* defaultTechnique();

struct TechniqueSettings {
  std::string technique = defaultTechnique();
  TransportSettings transport;
  BeamDivision beams;
  OwnSettings own;              // of the techniques, by the types of their structs
  std::filesystem::path baked;  // what `nephroid bake` wrote for the technique; empty: the cache is used
  bool operator==(const TechniqueSettings&) const = default;
};

// Those of transport and beams, then those of every technique; a struct that several techniques share comes
// once.
std::vector<SettingsView> allSettings(TechniqueSettings& settings);

// Those that the chosen technique uses.
std::vector<SettingsView> usedSettings(TechniqueSettings& settings);

// Those that the chosen technique's transport is made with: a baked file is its tables, unless the technique
// bakes something of its own.
TransportSettings transportOf(const TechniqueSettings& settings);

}  // namespace nephroid
