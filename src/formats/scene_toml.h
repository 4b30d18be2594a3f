// Reads scene files in TOML, table by table.
#pragma once

#include <filesystem>

#include "formats/toml_table.h"
#include "scene/scene.h"
#include "water/wave_simulation.h"

namespace nephroid {

// The scene in a .toml file. Throws InputError.
Scene loadTomlScene(const std::filesystem::path& file, double time, WaveRuns* waves = nullptr);
// Reads a scene from `text`, which stands for the text of `file` and may differ from the text on disk.
// readSceneFile returns the text on disk.
Scene readTomlScene(const std::string& text, const std::filesystem::path& file, double time,
                    WaveRuns* waves = nullptr);
std::string readSceneFile(const std::filesystem::path& file);

// Each of these reads one kind of table and adds it to `scene`.
void readMaterials(std::vector<TomlTable> tables, Scene& scene);
// The suns of skies come before the lights of the tables. `isBackgroundGiven`: skies are not seen then, but
// for those that say so.
void readLights(std::vector<TomlTable> tables, Scene& scene, bool isBackgroundGiven);
// The keys "phase" and "g" of what scatters light.
void readPhase(TomlTable& table, PhaseType& phase, float& g);
Medium readMedium(TomlTable table, const std::filesystem::path& folder);

// Adds objects to `scene`. Returns the first camera of the imported files, if there is one.
std::optional<Camera> readObjects(std::vector<TomlTable> tables, Scene& scene, WaveRuns* waves = nullptr);

// Euler angles in degrees, applied X first.
quat rotationOf(vec3 degrees);

// Limits of a dielectric's index of refraction and Abbe number.
inline constexpr Range kIor{kLowestIor, kHighestIor};
inline constexpr Range kAbbe{1, 10000};

// Makes the mesh of an [[object]] with the key "shape". For water it also sets object.water.
Mesh readShape(TomlTable& table, Object& object, const Scene& scene, WaveRuns* waves);

// Reads the key "name"; without it the name is `byDefault`. Throws InputError where one of `existing` has the
// same name.
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
