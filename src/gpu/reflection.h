// Reads the inputs of a shader from its SPIR-V module.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "gpu/vulkan.h"

namespace nephroid::gpu {

// The 64-bit FNV-1a hash of a name.
constexpr uint64_t hashOfName(std::string_view name) {
  uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

// An image, or an array of images, that a shader reads or writes.
struct ReflectedBinding {
  std::string name;
  uint64_t hash = 0;  // of the name
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  bool isLayered = false;  // the images are arrays with layers
  uint32_t count = 1;      // of images
  uint32_t numberAt = 0;   // index of the word in the module that holds the binding number
};

// A specialization constant.
struct ReflectedConstant {
  std::string name;
  uint32_t id = 0;  // its `constant_id`
};

struct Reflection {
  uint32_t pushConstantBytes = 0;
  std::array<uint32_t, 3> localSize{1, 1, 1};  // threads of a compute group
  // The constant_id of `local_size_x_id`, where the shader has one: a group is then one subgroup.
  std::optional<uint32_t> subgroupSizeId;
  std::vector<ReflectedBinding> bindings;
  std::vector<ReflectedConstant> constants;
};

// Throws std::logic_error for inputs that this folder does not support (other descriptor sets, descriptors
// that are not images).
Reflection reflect(const std::string& name, std::span<const uint32_t> spirv);

}  // namespace nephroid::gpu
