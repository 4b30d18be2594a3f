// The description that a technique's folder exports.
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

// What a technique is made from. Everything must outlive the technique.
struct TechniqueContext {
  gpu::Device& device;
  const TechniqueSettings& settings;
  SceneTransport& transport;
  Stats& stats;  // a technique sets its own counts here, and does not change others
  Casters casters = Casters::all;
  Progress* progress = nullptr;  // of `update`, by which it can be canceled; null: it cannot
};

// The parts of a scene that a preparation depends on and that a user may change.
struct PreparedParts {
  std::span<const Material> materials;
  std::span<const Placement> placements;  // of the objects
};

// A sensor that is to be read.
struct SensorRequest {
  const Scene& scene;
  const RayScene& rays;  // of the scene
  const Sensor& sensor;
  const TechniqueSettings& settings;
};

// What `nephroid bake` was asked to write.
struct BakeRequest {
  std::filesystem::path scene;  // for messages
  std::filesystem::path output;
  uint32_t first = 0;         // the first part to bake, where a bake can be done in parts
  uint32_t end = UINT32_MAX;  // one after the last part
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
  // What it leaves out, in addition to omissionsOfFrame().
  std::span<const Omission> omissions{};
  // The techniques that it consists of, if any. It has their settings too.
  std::span<const TechniqueInfo* const> parts{};

  // Does the long work before a first frame; called on its own thread. Null: there is none.
  void (*prepare)(const Scene& scene, SceneTransport& transport, const TechniqueSettings& settings,
                  Progress& progress) = nullptr;
  // Whether the preparation for `before` can be used for `after`; null: always.
  bool (*isStillPrepared)(const PreparedParts& before, const PreparedParts& after,
                          const TechniqueSettings& settings) = nullptr;
  // How `nephroid bake` writes its file. Without one, the file has light transport tables.
  TechniqueBake bake{};
  // Reads a sensor without a device: the illuminance (lux) of each texel, rows first, by light that met a
  // caster. Null: the sensor is read through the device, as a camera would see a receiver in its place.
  std::vector<vec3> (*measure)(const SensorRequest& request, Progress& progress, Stats& stats) = nullptr;
  // Whether `measure` uses beams that are cut at the sensor's own plane, in place of virtual planes, with
  // these settings; null: never.
  bool (*isInSensorPlane)(const TechniqueSettings& settings) = nullptr;
};

// `prepare` and `isStillPrepared` for a technique that takes its rays from the scene's transport.
void prepareTransport(const Scene& scene, SceneTransport& transport, const TechniqueSettings& settings,
                      Progress& progress);
bool isTransportStillPrepared(const PreparedParts& before, const PreparedParts& after,
                              const TechniqueSettings& settings);

}  // namespace nephroid
