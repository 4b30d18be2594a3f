// Reads glTF 2.0 (.gltf, .glb): meshes, node transforms, materials, lights and cameras. A material becomes
//
//   dielectric  where KHR_materials_transmission lets half of the light or more through; it is thin-walled
//               where KHR_materials_volume gives no thickness; its index of refraction is from
//               KHR_materials_ior and KHR_materials_dispersion
//   mirror      where it is metallic (0.5 or more) and smooth (roughness 0.1 or less), without a texture
//               for either
//   diffuse     otherwise, with its base color and its texture
//
// All functions throw InputError.
#pragma once

#include <filesystem>
#include <string>

#include "scene/scene.h"

namespace nephroid {

// Loads the file as a scene at `time` (s). Without a camera in the file, one is chosen that shows everything.
Scene loadGltfScene(const std::filesystem::path& file, double time);

// The contents of a file. Indices refer to the arrays of this struct.
struct GltfPart {
  std::vector<Texture> textures;
  std::vector<Material> materials;
  std::vector<Mesh> meshes;
  std::vector<Object> objects;
  std::vector<Light> lights;
  std::optional<Camera> camera;
};
GltfPart loadGltf(const std::filesystem::path& file, Faces faces = Faces::outward);

// Loads only the geometry: all nodes as one mesh.
Mesh loadGltfMesh(const std::filesystem::path& file, Faces faces);

}  // namespace nephroid
