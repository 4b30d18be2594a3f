// Vulkan as this folder sees it: entry points loaded at run time by volk, failures as exceptions.
#pragma once

#include <volk.h>

#include <string>

#include "core/error.h"

namespace nephroid::gpu {

// The device is gone, and with it all that is on it: another has to be made.
struct DeviceLost : RuntimeFailure {
  using RuntimeFailure::RuntimeFailure;
};

// Throws RuntimeFailure (DeviceLost where it is that) naming `what` was being done unless `result` says
// success.
void check(VkResult result, const std::string& what);

// A Vulkan struct, zero but for its type.
template <class T>
T structure(VkStructureType type) {
  T value{};
  value.sType = type;
  return value;
}

}  // namespace nephroid::gpu
