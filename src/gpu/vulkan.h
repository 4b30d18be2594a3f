// Vulkan as this folder sees it: entry points loaded at run time by volk, failures as exceptions.
#pragma once

#include <volk.h>

#include <string>

namespace nephroid::gpu {

// Throws RuntimeFailure naming `what` was being done unless `result` says success.
void check(VkResult result, const std::string& what);

// A Vulkan struct, zero but for its type.
template <class T>
T structure(VkStructureType type) {
  T value{};
  value.sType = type;
  return value;
}

}  // namespace nephroid::gpu
