// glTF 2.0 (.gltf, .glb): meshes, node transforms, materials, lights, cameras. Read for light transport: a
// material is
//   dielectric  when KHR_materials_transmission lets half of the light or more through (thin-walled without a
//               KHR_materials_volume thickness; index of refraction from _ior and _dispersion),
//   mirror      when it is metallic (0.5 or more) and smooth (roughness 0.1 or less, and no texture of
//   either), diffuse     otherwise, with its base colour and its texture.
// All throw InputError.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// The file as a scene: its first camera, or one that frames what it holds.
Scene loadGltfScene(const std::filesystem::path& file, double time);

// What a file adds to a scene. Indices count from the part's own arrays.
struct GltfPart {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Light> lights;
  std::optional<Camera> camera;
};
GltfPart loadGltf(const std::filesystem::path& file);

// The geometry alone, all nodes as one mesh.
Mesh loadGltfMesh(const std::filesystem::path& file);

}  // namespace nephroid
