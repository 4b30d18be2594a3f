// The Vulkan instance, and the messages of the validation layer.
#pragma once

#include <mutex>
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
  std::vector<std::string> validationMessages() const;
  void clearValidationMessages();

 private:
  VkInstance handle_ = VK_NULL_HANDLE;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  bool hasDebugNames_ = false;

  // Several threads may cause them.
  struct Messages {
    mutable std::mutex adding;
    std::vector<std::string> texts;
  };
  static VKAPI_ATTR VkBool32 VKAPI_CALL collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT,
                                                       VkDebugUtilsMessageTypeFlagsEXT,
                                                       const VkDebugUtilsMessengerCallbackDataEXT* data,
                                                       void* messages);
  Messages messages_;
};

}  // namespace nephroid::gpu
