#include "gpu_scene/gpu_scene.h"

#include <algorithm>
#include <bit>
#include <glm/gtc/packing.hpp>

#include "gpu/transfer.h"

namespace nephroid {
namespace {

uint32_t typeCode(MaterialType type) {
  switch (type) {
    case MaterialType::dielectric:
      return kMaterialDielectric;
    case MaterialType::mirror:
      return kMaterialMirror;
    default:
      return kMaterialDiffuse;
  }
}

SceneObject describe(const Object& object) {
  const mat3 linear = glm::mat3_cast(object.placement.rotation) * object.placement.scale;
  SceneObject described;
  for (int row = 0; row < 3; ++row)
    described.toWorld[row] =
        vec4(linear[0][row], linear[1][row], linear[2][row], object.placement.translation[row]);
  described.material = object.material;
  return described;
}

SceneMaterial describe(const Material& material) {
  SceneMaterial described;
  described.color = material.color;
  described.type = typeCode(material.type);
  described.emission = material.emission;
  described.ior = material.ior.y;
  described.attenuationColor = material.attenuationColor;
  described.inverseAttenuationDistance = material.inverseAttenuationDistance();
  return described;
}

std::vector<std::byte> asHalfFloats(const std::vector<vec4>& texels) {
  std::vector<uint64_t> halves(texels.size());
  std::ranges::transform(texels, halves.begin(), [](vec4 texel) { return glm::packHalf4x16(texel); });
  const auto bytes = std::as_bytes(std::span(halves));
  return {bytes.begin(), bytes.end()};
}

// The next mip level by averaging squares of four; an odd last row or column is averaged with itself.
std::vector<vec4> halved(const std::vector<vec4>& texels, uvec2 size) {
  const uvec2 half = glm::max(size / 2u, uvec2(1));
  std::vector<vec4> result(std::size_t{half.x} * half.y);
  for (uint32_t y = 0; y < half.y; ++y)
    for (uint32_t x = 0; x < half.x; ++x) {
      const auto at = [&](uint32_t dx, uint32_t dy) {
        return texels[std::size_t{std::min(2 * y + dy, size.y - 1)} * size.x +
                      std::min(2 * x + dx, size.x - 1)];
      };
      result[std::size_t{y} * half.x + x] = 0.25f * (at(0, 0) + at(1, 0) + at(0, 1) + at(1, 1));
    }
  return result;
}

gpu::Image uploadTexture(gpu::Device& device, const Texture& texture) {
  gpu::ImageOptions options{
      .format = VK_FORMAT_R16G16B16A16_SFLOAT, .width = texture.width, .height = texture.height};
  options.mipLevels = static_cast<uint32_t>(std::bit_width(std::max(texture.width, texture.height)));
  gpu::Image image = gpu::createImage(device, "texture " + texture.name, options);
  std::vector<std::vector<std::byte>> levels;
  std::vector<vec4> texels = texture.texels;
  uvec2 size(texture.width, texture.height);
  for (uint32_t level = 0; level < options.mipLevels; ++level) {
    levels.push_back(asHalfFloats(texels));
    texels = halved(texels, size);
    size = glm::max(size / 2u, uvec2(1));
  }
  gpu::uploadImage(device, image, levels);
  return image;
}

}  // namespace

GpuScene::GpuScene(gpu::Device& device, const Scene& scene) {
  std::vector<uint32_t> indices;
  std::vector<gpu::IndexRange> ranges;
  std::size_t vertexCount = 0;
  for (const Mesh& mesh : scene.meshes) {
    ranges.push_back({static_cast<uint32_t>(indices.size()), static_cast<uint32_t>(3 * mesh.triangles.size()),
                      static_cast<int32_t>(vertexCount)});
    for (const uvec3& triangle : mesh.triangles)
      indices.insert(indices.end(), {triangle.x, triangle.y, triangle.z});
    vertexCount += mesh.positions.size();
  }
  indices_ = gpu::upload(device, "scene indices", indices);
  vertices_ =
      gpu::createBuffer(device, "scene vertices", vertexCount * sizeof(SceneVertex), gpu::MemoryKind::upload);
  for (std::size_t i = 0; i < scene.meshes.size(); ++i)
    writeVertices(scene.meshes[i], static_cast<std::size_t>(ranges[i].vertexOffset));
  objects_ = gpu::createBuffer(device, "scene objects", scene.objects.size() * sizeof(SceneObject),
                               gpu::MemoryKind::upload);
  materials_ = gpu::createBuffer(device, "scene materials", scene.materials.size() * sizeof(SceneMaterial),
                                 gpu::MemoryKind::upload);
  uploadTextures(device, scene);
  for (uint32_t i = 0; i < scene.objects.size(); ++i) {
    const Material& material = scene.materialOf(scene.objects[i]);
    draws_.push_back({i, material.type, ranges[scene.objects[i].mesh], &texture(material.colorTexture)});
  }
  place(scene);
}

void GpuScene::uploadTextures(gpu::Device& device, const Scene& scene) {
  for (const Texture& texture : scene.textures) textures_.push_back(uploadTexture(device, texture));
  textures_.push_back(uploadTexture(device, Texture{"white", 1, 1, {vec4(1)}}));
  textureSampler_ =
      gpu::createSampler(device, {.address = VK_SAMPLER_ADDRESS_MODE_REPEAT, .mipmapped = true});
}

void GpuScene::writeVertices(const Mesh& mesh, std::size_t firstVertex) {
  const std::span<SceneVertex> vertices = vertices_.as<SceneVertex>().subspan(firstVertex);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    vertices[i] = {mesh.positions[i], mesh.normals[i], mesh.texcoords.empty() ? vec2(0) : mesh.texcoords[i]};
}

void GpuScene::place(const Scene& scene) {
  const std::span<SceneObject> objects = objects_.as<SceneObject>();
  for (std::size_t i = 0; i < scene.objects.size(); ++i) {
    const Object& object = scene.objects[i];
    objects[i] = describe(object);
    if (object.water)
      writeVertices(scene.meshOf(object), static_cast<std::size_t>(draws_[i].range.vertexOffset));
  }
  const std::span<SceneMaterial> materials = materials_.as<SceneMaterial>();
  for (std::size_t i = 0; i < scene.materials.size(); ++i) materials[i] = describe(scene.materials[i]);
}

}  // namespace nephroid
