// Includes Vulkan, whose functions are loaded at run time by volk, and turns failures into exceptions.
#pragma once

#include <volk.h>

#include <string>

#include "core/error.h"

namespace nephroid::gpu {

// The device was lost with everything on it. A new one has to be created.
struct DeviceLost : RuntimeFailure {
  using RuntimeFailure::RuntimeFailure;
};

// Throws RuntimeFailure, or DeviceLost, where `result` is an error. `what`: the work that failed, for the
// message.
void check(VkResult result, const std::string& what);

// A Vulkan struct with its type set and everything else zero.
template <class T>
T structure(VkStructureType type) {
  T value{};
  value.sType = type;
  return value;
}

}  // namespace nephroid::gpu
