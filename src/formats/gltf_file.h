// Opens glTF files and reads their arrays. Every offset, count and index is checked here, because tinygltf
// does not check them.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

struct GltfFile {
  std::string source;  // the file's name, with which every error message begins
  tinygltf::Model model;
  // The bytes of images that are not in a buffer view.
  std::vector<std::vector<unsigned char>> images;

  [[noreturn]] void fail(const std::string& what) const;
};

GltfFile openGltf(const std::filesystem::path& file);

// Checks that `index` is less than `count`. `what` is what it counts, for the error message: "accessor".
std::size_t gltfIndex(const GltfFile& file, int index, std::size_t count, const char* what);

// The numbers of an accessor of vectors with `components` numbers each. Normalized integers are returned as
// fractions.
struct GltfNumbers {
  std::size_t components = 0;
  std::vector<double> values;
  std::size_t count() const { return components ? values.size() / components : 0; }
};
GltfNumbers readGltfNumbers(const GltfFile& file, int accessor, std::size_t fewestComponents,
                            std::size_t mostComponents);

// Reads an accessor of single whole numbers.
std::vector<uint32_t> readGltfIndices(const GltfFile& file, int accessor);

// Decodes an image, and converts it from sRGB to linear.
Texture readGltfImage(const GltfFile& file, int image);

}  // namespace nephroid
