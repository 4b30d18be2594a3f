#include "gpu/instance.h"

#include <algorithm>
#include <array>
#include <cstring>

#include "core/error.h"

namespace nephroid::gpu {
namespace {

constexpr const char* kValidationLayer = "VK_LAYER_KHRONOS_validation";
constexpr const char* kInstallDriver =
    "install a graphics driver, or Mesa's software Vulkan (package mesa-vulkan-drivers)";

bool hasLayer(const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceLayerProperties(&count, nullptr);
  std::vector<VkLayerProperties> layers(count);
  vkEnumerateInstanceLayerProperties(&count, layers.data());
  return std::ranges::any_of(layers,
                             [&](const auto& layer) { return std::strcmp(layer.layerName, name) == 0; });
}

bool hasExtension(const char* layer, const char* name) {
  uint32_t count = 0;
  vkEnumerateInstanceExtensionProperties(layer, &count, nullptr);
  std::vector<VkExtensionProperties> extensions(count);
  vkEnumerateInstanceExtensionProperties(layer, &count, extensions.data());
  return std::ranges::any_of(extensions,
                             [&](const auto& e) { return std::strcmp(e.extensionName, name) == 0; });
}

}  // namespace

VkBool32 Instance::collectMessage(VkDebugUtilsMessageSeverityFlagBitsEXT, VkDebugUtilsMessageTypeFlagsEXT,
                                  const VkDebugUtilsMessengerCallbackDataEXT* data, void* messages) {
  Messages& all = *static_cast<Messages*>(messages);
  const std::lock_guard lock(all.adding);
  all.texts.emplace_back(data->pMessage);
  return VK_FALSE;
}

std::vector<std::string> Instance::validationMessages() const {
  const std::lock_guard lock(messages_.adding);
  return messages_.texts;
}

void Instance::clearValidationMessages() {
  const std::lock_guard lock(messages_.adding);
  messages_.texts.clear();
}

Instance::Instance(bool validation, const std::vector<std::string>& surfaceExtensions) {
  if (volkInitialize() != VK_SUCCESS)
    throw RuntimeFailure(std::string("no Vulkan loader (libvulkan.so.1) was found: ") + kInstallDriver);
  if (volkGetInstanceVersion() < VK_API_VERSION_1_3)
    throw RuntimeFailure("the Vulkan loader is older than 1.3: update package libvulkan1");
  if (validation && !hasLayer(kValidationLayer))
    throw RuntimeFailure(
        "Vulkan validation was asked for, but its layer is missing: install package "
        "vulkan-validationlayers");

  std::vector<const char*> extensions;
  hasDebugNames_ = hasExtension(nullptr, VK_EXT_DEBUG_UTILS_EXTENSION_NAME) ||
                   (validation && hasExtension(kValidationLayer, VK_EXT_DEBUG_UTILS_EXTENSION_NAME));
  if (hasDebugNames_) extensions.push_back(VK_EXT_DEBUG_UTILS_EXTENSION_NAME);
  if (validation) extensions.push_back(VK_EXT_VALIDATION_FEATURES_EXTENSION_NAME);
  for (const std::string& extension : surfaceExtensions) extensions.push_back(extension.c_str());

  auto messenger =
      structure<VkDebugUtilsMessengerCreateInfoEXT>(VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT);
  messenger.messageSeverity =
      VK_DEBUG_UTILS_MESSAGE_SEVERITY_WARNING_BIT_EXT | VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT;
  messenger.messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT;
  messenger.pfnUserCallback = collectMessage;
  messenger.pUserData = &messages_;

  const std::array enabled{VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT};
  auto features = structure<VkValidationFeaturesEXT>(VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT);
  features.pNext = &messenger;
  features.enabledValidationFeatureCount = static_cast<uint32_t>(enabled.size());
  features.pEnabledValidationFeatures = enabled.data();

  auto application = structure<VkApplicationInfo>(VK_STRUCTURE_TYPE_APPLICATION_INFO);
  application.pApplicationName = "nephroid";
  application.apiVersion = VK_API_VERSION_1_3;

  auto info = structure<VkInstanceCreateInfo>(VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO);
  info.pNext = validation ? &features : nullptr;
  info.pApplicationInfo = &application;
  info.enabledLayerCount = validation ? 1 : 0;
  info.ppEnabledLayerNames = &kValidationLayer;
  info.enabledExtensionCount = static_cast<uint32_t>(extensions.size());
  info.ppEnabledExtensionNames = extensions.data();
  const VkResult result = vkCreateInstance(&info, nullptr, &handle_);
  if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
    throw RuntimeFailure(std::string("no Vulkan driver was found: ") + kInstallDriver);
  if (result == VK_ERROR_EXTENSION_NOT_PRESENT)
    throw RuntimeFailure("the Vulkan loader knows no way to show pictures in this window system");
  check(result, "creating the instance");

  // Only instance-level entry points: the loader dispatches by handle, so that several devices can live side
  // by side.
  volkLoadInstance(handle_);
  if (validation) {
    const VkResult created = vkCreateDebugUtilsMessengerEXT(handle_, &messenger, nullptr, &messenger_);
    if (created != VK_SUCCESS) vkDestroyInstance(handle_, nullptr);
    check(created, "creating the debug messenger");
  }
}

Instance::~Instance() {
  if (messenger_) vkDestroyDebugUtilsMessengerEXT(handle_, messenger_, nullptr);
  vkDestroyInstance(handle_, nullptr);
}

std::vector<VkPhysicalDevice> Instance::physicalDevices() const {
  uint32_t count = 0;
  const VkResult result = vkEnumeratePhysicalDevices(handle_, &count, nullptr);
  if (result == VK_ERROR_INITIALIZATION_FAILED || (result == VK_SUCCESS && count == 0))
    throw RuntimeFailure(std::string("no Vulkan driver was found: ") + kInstallDriver);
  check(result, "enumerating devices");
  std::vector<VkPhysicalDevice> devices(count);
  check(vkEnumeratePhysicalDevices(handle_, &count, devices.data()), "enumerating devices");
  return devices;
}

}  // namespace nephroid::gpu
