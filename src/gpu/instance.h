// The connection to the Vulkan loader, and what its validation layer had to say.
#pragma once

#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace nephroid::gpu {

class Instance {
 public:
  // `surfaceExtensions`: what a window system needs. Throws RuntimeFailure, saying what to install, when
  // there is no loader, or no validation layer where one is wanted.
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
