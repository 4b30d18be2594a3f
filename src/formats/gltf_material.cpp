#include "formats/gltf_material.h"

#include <cmath>

#include "scene/dispersion.h"

namespace nephroid {
namespace {

constexpr double kLargest = 1e12;

const tinygltf::Value* extensionOf(const tinygltf::ExtensionMap& extensions, const char* name) {
  const auto found = extensions.find(name);
  return found != extensions.end() && found->second.IsObject() ? &found->second : nullptr;
}

vec3 color(const GltfFile& file, const std::vector<double>& factors, const char* what) {
  vec3 result(1);
  for (std::size_t k = 0; k < 3 && factors.size() >= 3; ++k) {
    if (!(factors[k] >= 0 && factors[k] <= 1)) file.fail(std::string(what) + " must be from 0 to 1");
    result[static_cast<int>(k)] = static_cast<float>(factors[k]);
  }
  return result;
}

std::vector<double> numbersOf(const tinygltf::Value& object, const char* key) {
  std::vector<double> numbers;
  if (!object.Has(key)) return numbers;
  const tinygltf::Value& array = object.Get(key);
  for (std::size_t i = 0; array.IsArray() && i < array.ArrayLen(); ++i) {
    const tinygltf::Value& element = array.Get(static_cast<int>(i));
    numbers.push_back(element.IsNumber() ? element.GetNumberAsDouble() : 0);
  }
  return numbers;
}

void readVolume(const GltfFile& file, const tinygltf::Value* volume, Material& material) {
  material.thinWalled = !volume || !(gltfNumber(file, *volume, "thicknessFactor", 0, 0, kLargest) > 0);
  if (material.thinWalled) return;
  material.attenuationColor = color(file, numbersOf(*volume, "attenuationColor"), "attenuationColor");
  if (volume->Has("attenuationDistance")) {
    material.attenuationDistance =
        static_cast<float>(gltfNumber(file, *volume, "attenuationDistance", 1, 1e-9, kLargest));
  }
}

void readIor(const GltfFile& file, const tinygltf::ExtensionMap& extensions, Material& material) {
  double ior = 1.5;
  if (const auto* extension = extensionOf(extensions, "KHR_materials_ior")) {
    ior = gltfNumber(file, *extension, "ior", ior, 1, 10);
  }
  double dispersion = 0;
  if (const auto* extension = extensionOf(extensions, "KHR_materials_dispersion")) {
    dispersion = gltfNumber(file, *extension, "dispersion", 0, 0, 100);
  }
  setDispersion(material, ior, dispersion);
}

glm::dmat3 textureTransform(const GltfFile& file, const tinygltf::TextureInfo& info, int& set) {
  const auto* extension = extensionOf(info.extensions, "KHR_texture_transform");
  if (!extension) return glm::dmat3(1);
  std::vector<double> offset = numbersOf(*extension, "offset"), scale = numbersOf(*extension, "scale");
  if (offset.size() != 2) offset = {0, 0};
  if (scale.size() != 2) scale = {1, 1};
  set = static_cast<int>(gltfNumber(file, *extension, "texCoord", set, 0, 1000));
  const double angle = gltfNumber(file, *extension, "rotation", 0, -1e6, 1e6);
  const double c = std::cos(angle), s = std::sin(angle);
  return glm::dmat3(1, 0, 0, 0, 1, 0, offset[0], offset[1], 1) * glm::dmat3(c, -s, 0, s, c, 0, 0, 0, 1) *
         glm::dmat3(scale[0], 0, 0, 0, scale[1], 0, 0, 0, 1);
}

void readBaseColorTexture(const GltfFile& file, const tinygltf::TextureInfo& info, GltfMaterial& result) {
  if (info.index < 0) return;
  const auto& texture =
      file.model.textures[gltfIndex(file, info.index, file.model.textures.size(), "texture")];
  result.image = static_cast<int>(gltfIndex(file, texture.source, file.model.images.size(), "image"));
  result.texcoordSet = info.texCoord;
  result.texcoordTransform = textureTransform(file, info, result.texcoordSet);
}

}  // namespace

double gltfNumber(const GltfFile& file, const tinygltf::Value& object, const char* key, double byDefault,
                  double lowest, double highest) {
  if (!object.Has(key)) return byDefault;
  const tinygltf::Value& value = object.Get(key);
  const double number = value.IsNumber() ? value.GetNumberAsDouble() : std::nan("");
  if (!(number >= lowest && number <= highest)) {
    file.fail("\"" + std::string(key) + "\" must be a number from " + std::to_string(lowest) + " to " +
              std::to_string(highest));
  }
  return number;
}

GltfMaterial readGltfMaterial(const GltfFile& file, int index) {
  GltfMaterial result;
  Material& material = result.material;
  material.color = vec3(1);
  material.name = "default";
  if (index < 0) return result;
  const auto& given = file.model.materials[gltfIndex(file, index, file.model.materials.size(), "material")];
  const auto& surface = given.pbrMetallicRoughness;
  material.name = given.name.empty() ? "material " + std::to_string(index) : given.name;
  material.color = color(file, surface.baseColorFactor, "baseColorFactor");
  const auto* transmission = extensionOf(given.extensions, "KHR_materials_transmission");
  if (transmission && gltfNumber(file, *transmission, "transmissionFactor", 0, 0, 1) >= 0.5) {
    material.type = MaterialType::dielectric;
    readVolume(file, extensionOf(given.extensions, "KHR_materials_volume"), material);
    readIor(file, given.extensions, material);
    return result;
  }
  const bool isSmoothMetal = surface.metallicFactor >= 0.5 && surface.roughnessFactor <= 0.1 &&
                             surface.metallicRoughnessTexture.index < 0;
  if (isSmoothMetal) {
    material.type = MaterialType::mirror;
    return result;
  }
  readBaseColorTexture(file, surface.baseColorTexture, result);
  double strength = 1;
  if (const auto* emission = extensionOf(given.extensions, "KHR_materials_emissive_strength")) {
    strength = gltfNumber(file, *emission, "emissiveStrength", 1, 0, kLargest);
  }
  if (!given.emissiveFactor.empty()) {
    material.emission = static_cast<float>(strength) * color(file, given.emissiveFactor, "emissiveFactor");
  }
  return result;
}

}  // namespace nephroid
