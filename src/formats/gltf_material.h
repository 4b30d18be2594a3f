#pragma once

#include "formats/gltf_file.h"

namespace nephroid {

struct GltfMaterial {
  Material material;  // its colorTexture is not set
  int image = -1;     // of the base colour, for a diffuse material
  int texcoordSet = 0;
  glm::dmat3 texcoordTransform{1};  // KHR_texture_transform
};

// The material `index`; the format's default for -1.
GltfMaterial readGltfMaterial(const GltfFile& file, int index);

// A number of an extension, within `lowest` and `highest`.
double gltfNumber(const GltfFile& file, const tinygltf::Value& object, const char* key, double byDefault,
                  double lowest, double highest);

}  // namespace nephroid
