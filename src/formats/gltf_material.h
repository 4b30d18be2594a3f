// Materials of a glTF file.
#pragma once

#include "formats/gltf_file.h"

namespace nephroid {

struct GltfMaterial {
  Material material;  // without its colorTexture
  int image = -1;     // index of the base color's image, for a diffuse material; -1: none
  int texcoordSet = 0;
  glm::dmat3 texcoordTransform{1};  // KHR_texture_transform
};

// Reads the material `index`; -1 gives glTF's default material.
GltfMaterial readGltfMaterial(const GltfFile& file, int index);

// Reads a number of an extension. Throws InputError where it is not between `lowest` and `highest`.
double gltfNumber(const GltfFile& file, const tinygltf::Value& object, const char* key, double byDefault,
                  double lowest, double highest);

}  // namespace nephroid
