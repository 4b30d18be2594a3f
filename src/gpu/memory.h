// Allocates device memory in large blocks and divides them (first fit), because drivers allow few
// allocations, and each is slow.
#pragma once

#include <cstddef>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "gpu/vulkan.h"

namespace nephroid::gpu {

enum class MemoryKind {
  device,    // fastest for the device
  upload,    // written by the host, read by the device; mapped
  readback,  // written by the device, read by the host; mapped
};

struct MemoryBlock;

// A piece of a block; given back with MemoryPool::release.
struct Allocation {
  MemoryBlock* block = nullptr;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize offset = 0;      // bytes into `memory`
  VkDeviceSize size = 0;        // bytes
  std::byte* mapped = nullptr;  // null for MemoryKind::device
};

class MemoryPool {
 public:
  MemoryPool(VkPhysicalDevice physicalDevice, VkDevice device, std::string deviceName);
  ~MemoryPool();
  MemoryPool(const MemoryPool&) = delete;
  MemoryPool& operator=(const MemoryPool&) = delete;

  // Throws RuntimeFailure with the number of bytes and with `name`, the purpose of the memory.
  Allocation allocate(const VkMemoryRequirements& requirements, MemoryKind kind, const std::string& name);
  void release(const Allocation& allocation);
  uint64_t usedBytes() const;
  uint64_t allocationCount() const;  // allocations that are in use

 private:
  uint32_t memoryType(uint32_t allowedTypes, MemoryKind kind) const;
  MemoryBlock& newBlock(uint32_t type, VkDeviceSize size, MemoryKind kind, const std::string& name);

  mutable std::mutex use_;
  VkDevice device_;
  std::string deviceName_;
  VkPhysicalDeviceMemoryProperties properties_{};
  VkDeviceSize granularity_ = 1;
  uint64_t usedBytes_ = 0;
  uint64_t allocationCount_ = 0;
  std::vector<std::unique_ptr<MemoryBlock>> blocks_;
};

}  // namespace nephroid::gpu
