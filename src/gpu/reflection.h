// What a SPIR-V module says of itself: how it is fed.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace nephroid::gpu {

struct ReflectedBinding {
  uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_IMAGE;
  bool isArrayed = false;  // an image with layers
  std::string name;
};

struct Reflection {
  uint32_t pushConstantBytes = 0;
  std::array<uint32_t, 3> localSize{1, 1, 1};  // threads of a compute group
  std::vector<ReflectedBinding> bindings;      // of set 0, ascending
};

// Throws std::logic_error on a module this folder cannot feed (other sets, descriptors that are not images).
Reflection reflect(const std::string& name, std::span<const uint32_t> spirv);

}  // namespace nephroid::gpu
