#pragma once

#include <filesystem>

#include "formats/toml_table.h"
#include "scene/scene.h"
#include "water/wave_simulation.h"

namespace nephroid {

// The scene in a .toml file. Throws InputError.
Scene loadTomlScene(const std::filesystem::path& file, double time, WaveRuns* waves = nullptr);
// The same of its text, which may have changed since; and that text as the file has it.
Scene readTomlScene(const std::string& text, const std::filesystem::path& file, double time,
                    WaveRuns* waves = nullptr);
std::string readSceneFile(const std::filesystem::path& file);

// The parts of it. Each adds to `scene` what its tables say.
void readMaterials(std::vector<TomlTable> tables, Scene& scene);
void readLights(std::vector<TomlTable> tables, Scene& scene);
// The keys "phase" and "g" of what scatters light.
void readPhase(TomlTable& table, PhaseType& phase, float& g);
Medium readMedium(TomlTable table, const std::filesystem::path& folder);

// As above; gives the first camera that was imported.
std::optional<Camera> readObjects(std::vector<TomlTable> tables, Scene& scene, WaveRuns* waves = nullptr);

// Euler angles in degrees, applied X first.
quat rotationOf(vec3 degrees);

// Of a dielectric.
inline constexpr Range kIor{kLowestIor, kHighestIor};
inline constexpr Range kAbbe{1, 10000};

// The mesh of an [[object]] that has a `shape`; sets object.water for water.
Mesh readShape(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves);

// The key `name`, or `byDefault`; an error where one of `existing` has it already.
template <class Named>
std::string readName(TomlTable& table, const std::vector<Named>& existing, const std::string& byDefault) {
  const auto given = table.text("name");
  const std::string name = given.value_or(byDefault);
  for (const Named& other : existing) {
    if (other.name == name) table.fail("name", "\"" + name + "\" is taken already; names must differ");
  }
  return name;
}

}  // namespace nephroid
