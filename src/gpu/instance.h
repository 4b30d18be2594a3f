// The Vulkan instance, and the messages of the validation layer.
#pragma once

#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace nephroid::gpu {

class Instance {
 public:
  // `surfaceExtensions`: the extensions of the window system. Throws RuntimeFailure where there is no Vulkan
  // loader, or no validation layer although `validation` is set; the message tells what to install.
  explicit Instance(bool validation, const std::vector<std::string>& surfaceExtensions = {});
  ~Instance();
  Instance(const Instance&) = delete;
  Instance& operator=(const Instance&) = delete;

  VkInstance handle() const { return handle_; }
  bool hasDebugNames() const { return hasDebugNames_; }
  std::vector<VkPhysicalDevice> physicalDevices() const;

  // Warnings and errors of the validation layer since the instance was made or they were last cleared.
  const std::vector<std::string>& validationMessages() const { return messages_; }
  void clearValidationMessages() { messages_.clear(); }

 private:
  VkInstance handle_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  bool hasDebugNames_ = false;
  std::vector<std::string> messages_;
};

}  // namespace nephroid::gpu
