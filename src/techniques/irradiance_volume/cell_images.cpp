#include "techniques/irradiance_volume/cell_images.h"

#include <algorithm>
#include <glm/gtc/packing.hpp>
#include <optional>

#include "irradiance_volume/lookup.h"

namespace nephroid {
namespace {

constexpr VkDeviceSize kVectorBytes = 8, kTintBytes = 4;
constexpr float kLargestHalf = 65504;
constexpr float kOneColor = 1e-4f;  // of cells that keep colors in steps of 1/255

void ensureImage(gpu::Device& device, gpu::Image& image, const char* name, VkFormat format, uvec3 size) {
  if (image && uvec3(image.width(), image.height(), image.layerCount()) == size) return;
  image =
      gpu::createImage(device, name, {.format = format, .width = size.x, .height = size.y, .layers = size.z});
}

VkDeviceSize texels(const gpu::Image& image) {
  return VkDeviceSize{image.width()} * image.height() * image.layerCount();
}

}  // namespace

void stageCells(gpu::Device& device, CellImages& images, uvec3 size, uint32_t first,
                std::span<const uint32_t> words) {
  ensureImage(device, images.vectors, "irradiance vectors", VK_FORMAT_R16G16B16A16_SFLOAT, size);
  const std::size_t cells = std::size_t{size.x} * size.y * size.z;
  gpu::ensureBuffer(device, images.staged, "irradiance cells", cells * (kVectorBytes + kTintBytes),
                    gpu::MemoryKind::upload);
  const std::span<uint64_t> vectors = images.staged.as<uint64_t>();
  const std::span<uint32_t> tints =
      images.staged.as<uint32_t>().subspan(cells * kVectorBytes / sizeof(uint32_t));
  const VolumeView volume{size, words.data()};
  std::optional<vec3> color;  // of the first cell with light
  bool isTinted = false;
  for (std::size_t i = 0; i < cells; ++i) {
    VolumeLight light = noLight();
    addCell(volume, first + uint32_t(i), 1, light);
    const float brightness = light.color.x + light.color.y + light.color.z;
    if (brightness > 0) {
      const vec3 own = 3.0f / brightness * light.color;
      if (!color) color = own;
      isTinted |= glm::any(glm::greaterThan(abs(own - *color), vec3(kOneColor)));
    }
    vectors[i] = glm::packHalf4x16(vec4(light.vector, std::min(brightness, kLargestHalf)));
    tints[i] = glm::packHalf2x16(min(vec2(light.color.x, light.color.z), vec2(kLargestHalf)));
  }
  images.color = isTinted ? vec3(1) : color.value_or(vec3(1));
  if (isTinted)
    ensureImage(device, images.tints, "irradiance tints", VK_FORMAT_R16G16_SFLOAT, size);
  else
    images.tints = {};
}

uint64_t cellBytes(const CellImages& images) {
  if (!images.vectors) return 0;
  return (kVectorBytes + (images.tints ? kTintBytes : 0)) * texels(images.vectors);
}

void copyCells(gpu::CommandList& commands, const CellImages& images) {
  const VkDeviceSize layerCells = texels(images.vectors) / images.vectors.layerCount();
  const VkDeviceSize tintsFrom = kVectorBytes * texels(images.vectors);
  for (uint32_t layer = 0; layer < images.vectors.layerCount(); ++layer) {
    commands.copy(images.staged, layer * layerCells * kVectorBytes, images.vectors, layer);
    if (images.tints)
      commands.copy(images.staged, tintsFrom + layer * layerCells * kTintBytes, images.tints, layer);
  }
}

}  // namespace nephroid
