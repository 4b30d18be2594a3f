#include "formats/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <fstream>

#include "core/error.h"
#include "formats/gltf.h"
#include "formats/mesh_formats.h"

namespace nephroid {
namespace {

constexpr const char* kDefaultModels = "/usr/share/glmark2/models";
constexpr std::uintmax_t kLargestMeshFile = std::uintmax_t{4} << 30;  // bytes

std::vector<std::filesystem::path> modelDirectories() {
  const char* variable = std::getenv("NEPHROID_MODELS");
  const std::string list = variable && *variable ? variable : kDefaultModels;
  std::vector<std::filesystem::path> directories;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(':', begin), list.size());
    if (end > begin) directories.emplace_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return directories;
}

}  // namespace

std::string lowerExtension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

std::string oneLine(std::string text) {
  for (char& c : text) {
    if (std::iscntrl(static_cast<unsigned char>(c))) c = ' ';
  }
  while (!text.empty() && text.back() == ' ') text.pop_back();
  return text;
}

std::string readFile(const std::filesystem::path& file, std::uintmax_t largest) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) throw InputError(oneLine(file.string()) + ": there is no such file");
  if (!std::filesystem::is_regular_file(status))
    throw InputError(oneLine(file.string()) + ": not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw InputError(oneLine(file.string()) + ": cannot be read: " + error.message());
  if (size > largest) {
    throw InputError(oneLine(file.string()) + ": " + std::to_string(size) + " bytes; at most " +
                     std::to_string(largest) + " are read");
  }
  std::ifstream stream(file, std::ios::binary);
  std::string text(static_cast<std::size_t>(size), '\0');
  if (!stream || (size > 0 && !stream.read(text.data(), static_cast<std::streamsize>(size)))) {
    throw InputError(oneLine(file.string()) + ": cannot be read");
  }
  return text;
}

std::filesystem::path findModel(const std::filesystem::path& name,
                                const std::filesystem::path& sceneDirectory, const std::string& where) {
  std::vector<std::filesystem::path> directories{sceneDirectory.empty() ? "." : sceneDirectory};
  if (name.is_relative()) {
    const auto models = modelDirectories();
    directories.insert(directories.end(), models.begin(), models.end());
  }
  std::string looked;
  for (const auto& directory : directories) {
    const std::filesystem::path candidate = directory / name;
    std::error_code error;
    if (std::filesystem::is_regular_file(candidate, error)) return candidate;
    looked += (looked.empty() ? "" : ", ") + candidate.string();
  }
  throw InputError(oneLine(where + "there is no \"" + name.string() + "\"; looked for " + looked +
                           " (set NEPHROID_MODELS to add directories)"));
}

Mesh loadMeshFile(const std::filesystem::path& file, Faces faces) {
  const std::string extension = lowerExtension(file), source = oneLine(file.string());
  if (extension == ".gltf" || extension == ".glb") return loadGltfMesh(file, faces);
  if (extension == ".obj") return readObj(readFile(file, kLargestMeshFile), source, faces);
  if (extension == ".ply") return readPly(readFile(file, kLargestMeshFile), source, faces);
  if (extension == ".3ds") return read3ds(readFile(file, kLargestMeshFile), source, faces);
  throw InputError(source + ": a mesh is an .obj, .ply, .3ds, .gltf or .glb file");
}

}  // namespace nephroid
