#include "gpu/vulkan.h"

namespace nephroid::gpu {
namespace {

const char* describe(VkResult result) {
  switch (result) {
    case VK_ERROR_OUT_OF_HOST_MEMORY:
      return "out of memory";
    case VK_ERROR_OUT_OF_DEVICE_MEMORY:
      return "out of device memory";
    case VK_ERROR_DEVICE_LOST:
      return "the device was lost; the driver reset it or it ran too long";
    case VK_ERROR_INITIALIZATION_FAILED:
      return "the driver could not be initialized";
    case VK_ERROR_INCOMPATIBLE_DRIVER:
      return "no compatible driver";
    case VK_TIMEOUT:
      return "timed out";
    default:
      return nullptr;
  }
}

}  // namespace

void check(VkResult result, const std::string& what) {
  if (result == VK_SUCCESS) return;
  const char* reason = describe(result);
  const std::string message =
      "Vulkan: " + what + ": " +
      (reason ? std::string(reason) : "error " + std::to_string(static_cast<int>(result)));
  if (result == VK_ERROR_DEVICE_LOST) throw DeviceLost(message);
  throw RuntimeFailure(message);
}

}  // namespace nephroid::gpu
