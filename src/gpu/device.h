// A Vulkan 1.3 device with one queue. Work is recorded, submitted and waited for. The same commands give the
// same bytes. After submitAndWait the device uses nothing that the caller owns. Several threads may use it,
// each its own buffers, images and programs: the work of one waits for that of another.
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "core/stats.h"
#include "gpu/instance.h"
#include "gpu/memory.h"
#include "gpu/vulkan.h"

namespace nephroid::gpu {

class CommandList;

struct DeviceOptions {
  std::string
      device;  // index or part of the name; empty: the first of discrete, integrated, virtual, software
  bool validation = false;  // Khronos validation layer with synchronization validation; NEPHROID_VALIDATION=1
                            // turns it on too
  // Instance extensions of the window system. Where they are given, the device can show images (Swapchain).
  std::vector<std::string> surfaceExtensions{};
  uint32_t subgroupSize = 0;  // one of DeviceInfo::subgroupSizes; 0: the device's own choice
};

struct DeviceInfo {
  uint32_t index = 0;
  std::string name;
  std::string type;        // "discrete", "integrated", "virtual", "software" or "other"
  std::string driver;      // name and version
  std::string apiVersion;  // "1.3.230"
  // The subgroup sizes (threads, 4..64) that a compute shader can ask for, ascending.
  std::vector<uint32_t> subgroupSizes;
  std::vector<std::string> missing;  // the features that it lacks; empty: it is usable
};

// All devices of this machine. Throws RuntimeFailure when there is no loader or no driver.
std::vector<DeviceInfo> listDevices();

class Device {
 public:
  // Throws InputError where `options.device` fits no device, RuntimeFailure where no device is usable.
  explicit Device(const DeviceOptions& options = {});
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  // Records, submits and waits. Returns the times of the passes, in the order in which they began; empty
  // where the device has no timestamps.
  std::vector<PassTime> submitAndWait(const std::function<void(CommandList&)>& record);

  // Shows an image of a window, and waits for what was shown, as the functions of Vulkan do.
  VkResult present(const VkPresentInfoKHR& what);
  void waitForQueue();

  VkInstance instance() const { return instance_.handle(); }
  VkDevice handle() const { return handle_; }
  uint32_t queueFamily() const { return queueFamily_; }
  VkPhysicalDevice physicalDevice() const { return physicalDevice_; }
  const DeviceInfo& info() const { return info_; }
  const VkPhysicalDeviceLimits& limits() const { return limits_; }
  // The number of threads in a compute group that is one subgroup.
  uint32_t subgroupSize() const { return subgroupSize_; }
  MemoryPool& memory() { return *memory_; }
  uint64_t memoryBytes() const { return memory_->usedBytes(); }  // in buffers and images now

  std::vector<std::string> validationMessages() const { return instance_.validationMessages(); }
  void clearValidationMessages() { instance_.clearValidationMessages(); }

  // The object's name in debuggers, captures and validation messages.
  void setName(VkObjectType type, uint64_t object, const std::string& name) const;
  bool hasDebugNames() const { return instance_.hasDebugNames(); }

 private:
  void createDevice(bool showsPictures);
  std::vector<PassTime> readPassTimes(const CommandList& commands) const;

  Instance instance_;
  VkPhysicalDevice physicalDevice_ = VK_NULL_HANDLE;
  DeviceInfo info_;
  VkPhysicalDeviceLimits limits_{};
  uint32_t subgroupSize_ = 0;
  uint32_t queueFamily_ = 0;
  uint32_t timestampBits_ = 0;
  VkDevice handle_ = VK_NULL_HANDLE;
  std::mutex queueUse_;
  VkQueue queue_ = VK_NULL_HANDLE;
  VkCommandPool commandPool_ = VK_NULL_HANDLE;
  VkCommandBuffer commandBuffer_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  VkQueryPool queryPool_ = VK_NULL_HANDLE;
  std::unique_ptr<MemoryPool> memory_;
};

}  // namespace nephroid::gpu
