// The techniques by name: a further one is a folder of its own and a line in registry.cpp.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "core/progress.h"
#include "core/stats.h"
#include "techniques/light_beams.h"
#include "techniques/omissions.h"
#include "techniques/settings.h"
#include "techniques/sources.h"
#include "techniques/technique.h"

namespace nephroid {

// What a technique is made with. All outlive it.
struct TechniqueContext {
  gpu::Device& device;
  const TechniqueSettings& settings;
  SceneTransport& transport;
  Stats& stats;  // a technique adds its counts
  Casters casters = Casters::all;
};

// What suits each caster.
inline constexpr const char* kAutomaticName = "automatic";

struct TechniqueEntry {
  const char* name;
  std::unique_ptr<Technique> (*make)(const TechniqueContext& context);
  std::span<const Omission> (*omissions)();
};

std::span<const TechniqueEntry> techniques();

// The technique `settings.technique` names. Throws InputError with the nearest name when there is none of
// that name.
std::unique_ptr<Technique> makeTechnique(const TechniqueContext& context);

}  // namespace nephroid
