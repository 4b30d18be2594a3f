// A scene on the device. Geometry and textures are sent once; `place` sends what may change from frame to
// frame.
#pragma once

#include <algorithm>
#include <vector>

#include "gpu/command_list.h"
#include "gpu_scene/scene_data.h"
#include "scene/scene.h"

namespace nephroid {

// What is needed to draw one object: its part of GpuScene::indices(), and its texture.
struct SceneDraw {
  uint32_t object = 0;  // index in Scene::objects
  MaterialType type = MaterialType::diffuse;
  gpu::IndexRange range;
  const gpu::Image* colorTexture = nullptr;  // white where the material has none
};

class GpuScene {
 public:
  GpuScene(gpu::Device& device, const Scene& scene);

  // Takes placements, materials and the shape of water from `scene`. It must have the same objects and meshes
  // as the scene of the constructor. An object that moves costs an upload of 52 bytes.
  void place(const Scene& scene);

  const std::vector<SceneDraw>& draws() const { return draws_; }  // one for each object, in their order
  const gpu::Buffer& indices() const { return indices_; }
  uint64_t vertices() const { return vertices_.address(); }    // SceneVertex[]
  uint64_t objects() const { return objects_.address(); }      // SceneObject[]
  uint64_t materials() const { return materials_.address(); }  // SceneMaterial[]
  // The texture of this index in Scene::textures, in linear half floats; a white one for kNone.
  const gpu::Image& texture(uint32_t index) const {
    return textures_[std::min<std::size_t>(index, textures_.size() - 1)];
  }
  const gpu::Sampler& textureSampler() const { return textureSampler_; }

 private:
  void writeVertices(const Mesh& mesh, std::size_t firstVertex);
  void uploadTextures(gpu::Device& device, const Scene& scene);

  std::vector<SceneDraw> draws_;
  gpu::Buffer vertices_;
  gpu::Buffer indices_;
  gpu::Buffer objects_;
  gpu::Buffer materials_;
  std::vector<gpu::Image> textures_;  // as Scene::textures, and a white one last
  gpu::Sampler textureSampler_;
};

}  // namespace nephroid
