// A glTF file opened, and its arrays read with every offset, count and index held against what is there:
// tinygltf checks none.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

struct GltfFile {
  std::string source;  // begins every error
  tinygltf::Model model;
  // The bytes of images that stand by themselves; those in buffers are found through their buffer view.
  std::vector<std::vector<unsigned char>> images;

  [[noreturn]] void fail(const std::string& what) const;
};

GltfFile openGltf(const std::filesystem::path& file);

// `index` as a place among `count` of `what` ("accessor").
std::size_t gltfIndex(const GltfFile& file, int index, std::size_t count, const char* what);

// An accessor of vectors with `components` numbers; normalized integers come as fractions.
struct GltfNumbers {
  std::size_t components = 0;
  std::vector<double> values;
  std::size_t count() const { return components ? values.size() / components : 0; }
};
GltfNumbers readGltfNumbers(const GltfFile& file, int accessor, std::size_t fewestComponents,
                            std::size_t mostComponents);

// The scalar whole numbers of an accessor.
std::vector<uint32_t> readGltfIndices(const GltfFile& file, int accessor);

// The image decoded, sRGB made linear.
Texture readGltfImage(const GltfFile& file, int image);

}  // namespace nephroid
