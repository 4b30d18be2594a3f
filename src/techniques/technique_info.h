// What a technique's folder exports: all that the rest of the program has to know of it.
#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "beams/light_beams.h"
#include "core/progress.h"
#include "core/settings.h"
#include "core/stats.h"
#include "techniques/omissions.h"
#include "techniques/settings.h"
#include "techniques/technique.h"
#include "transport/scene_transport.h"

namespace nephroid {

// What a technique is made with. All outlive it.
struct TechniqueContext {
  gpu::Device& device;
  const TechniqueSettings& settings;
  SceneTransport& transport;
  Stats& stats;  // a technique sets counts of its own in it, and leaves the others
  Casters casters = Casters::all;
};

// What of a scene a preparation is made of and hands may change.
struct PreparedParts {
  std::span<const Material> materials;
  std::span<const Placement> placements;  // of the objects
};

// A file of `nephroid bake`.
struct BakeRequest {
  std::filesystem::path scene;  // for messages
  std::filesystem::path output;
  uint32_t first = 0;         // of the parts that are baked, where a bake can be done in parts
  uint32_t end = UINT32_MAX;  // past the last of them
};

struct TechniqueBake {
  const char* what = nullptr;  // "irradiance volumes"
  // Throws InputError where there is nothing to bake.
  void (*write)(const Scene& scene, const TechniqueSettings& settings, const BakeRequest& request,
                Progress& progress) = nullptr;
  // Joins files of parts; null where there are no parts.
  void (*merge)(std::span<const std::filesystem::path> parts, const std::filesystem::path& output) = nullptr;
};

struct TechniqueInfo {
  const char* name;
  const char* summary;  // one line: what it does and what it is for
  std::unique_ptr<Technique> (*make)(const TechniqueContext& context);
  TechniqueTraits traits;
  // Its own settings. Those of transport and of beams are every technique's.
  std::span<const SettingsOwner> settings{};
  // What it leaves out of what the reference computes, besides what the frame does.
  std::span<const Omission> omissions{};
  // What it is made of, where it chooses among others; their settings are its own too.
  std::span<const TechniqueInfo* const> parts{};

  // What takes long before a first frame, on a thread of its own; null: nothing does.
  void (*prepare)(const Scene& scene, SceneTransport& transport, const TechniqueSettings& settings,
                  Progress& progress) = nullptr;
  // Whether what was prepared for `before` can draw `after`; null: always.
  bool (*isStillPrepared)(const PreparedParts& before, const PreparedParts& after,
                          const TechniqueSettings& settings) = nullptr;
  // What `nephroid bake` writes for it, and --baked gives back to it; without one, light transport tables.
  TechniqueBake bake{};
  // Whether these settings ask `measure` for beams cut by the sensor's own plane in place of planes; null: no
  // settings do.
  bool (*isInSensorPlane)(const TechniqueSettings& settings) = nullptr;
};

// For a technique that takes its rays from the scene's transport: makes the source, and says whether it
// holds.
void prepareTransport(const Scene& scene, SceneTransport& transport, const TechniqueSettings& settings,
                      Progress& progress);
bool isTransportStillPrepared(const PreparedParts& before, const PreparedParts& after,
                              const TechniqueSettings& settings);

}  // namespace nephroid
