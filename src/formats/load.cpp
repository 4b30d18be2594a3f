#include "formats/load.h"

#include "core/error.h"
#include "formats/gltf.h"
#include "formats/mesh_file.h"
#include "formats/scene_toml.h"

namespace nephroid {

Scene loadScene(const std::filesystem::path& file, double time, WaveRuns* waves) {
  const std::string extension = lowerExtension(file);
  if (extension == ".toml") return loadTomlScene(file, time, waves);
  if (extension == ".gltf" || extension == ".glb") return loadGltfScene(file, time);
  throw InputError(oneLine(file.string() + ": a scene is a .toml, .gltf or .glb file"));
}

}  // namespace nephroid
