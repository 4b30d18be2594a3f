#include "scene/load.h"

#include <algorithm>
#include <cctype>

#include "core/error.h"
#include "scene/mesh_file.h"
#include "scene/scene_toml.h"

namespace nephroid {

Scene loadScene(const std::filesystem::path& file, double time) {
  const std::string extension = lowerExtension(file);
  if (extension == ".toml") return loadTomlScene(file, time);
  throw InputError(oneLine(file.string() + ": \"" + extension + "\" is no scene; a scene is a .toml file"));
}

}  // namespace nephroid
