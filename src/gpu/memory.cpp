#include "gpu/memory.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "core/error.h"

namespace nephroid::gpu {

struct MemoryBlock {
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkDeviceSize size = 0;
  uint32_t type = 0;
  MemoryKind kind = MemoryKind::device;
  std::byte* mapped = nullptr;
  std::map<VkDeviceSize, VkDeviceSize> free;  // offset to size, neighbors always joined

  std::optional<VkDeviceSize> take(VkDeviceSize bytes, VkDeviceSize alignment) {
    for (const auto& [offset, available] : free) {
      const VkDeviceSize aligned = (offset + alignment - 1) / alignment * alignment;
      if (aligned + bytes > offset + available) continue;
      const VkDeviceSize end = offset + available;
      const VkDeviceSize before = aligned - offset;
      free.erase(offset);
      if (before > 0) free[aligned - before] = before;
      if (aligned + bytes < end) free[aligned + bytes] = end - (aligned + bytes);
      return aligned;
    }
    return std::nullopt;
  }

  void giveBack(VkDeviceSize offset, VkDeviceSize bytes) {
    auto next = free.lower_bound(offset);
    if (next != free.end() && next->first == offset + bytes) {
      bytes += next->second;
      next = free.erase(next);
    }
    if (next != free.begin()) {
      const auto previous = std::prev(next);
      if (previous->first + previous->second == offset) {
        previous->second += bytes;
        return;
      }
    }
    free[offset] = bytes;
  }
};

namespace {

constexpr VkDeviceSize kBlockBytes = VkDeviceSize{32} << 20;

struct Preference {
  VkMemoryPropertyFlags required;
  VkMemoryPropertyFlags preferred;
};

Preference preferenceOf(MemoryKind kind) {
  constexpr VkMemoryPropertyFlags kMapped =
      VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT;
  switch (kind) {
    case MemoryKind::upload:
      return {kMapped, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
    case MemoryKind::readback:
      return {kMapped, VK_MEMORY_PROPERTY_HOST_CACHED_BIT};
    default:
      return {0, VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT};
  }
}

}  // namespace

MemoryPool::MemoryPool(VkPhysicalDevice physicalDevice, VkDevice device, std::string deviceName)
    : device_(device), deviceName_(std::move(deviceName)) {
  vkGetPhysicalDeviceMemoryProperties(physicalDevice, &properties_);
  VkPhysicalDeviceProperties properties;
  vkGetPhysicalDeviceProperties(physicalDevice, &properties);
  granularity_ = std::max<VkDeviceSize>(properties.limits.bufferImageGranularity, 1);
}

MemoryPool::~MemoryPool() {
  for (const auto& block : blocks_) vkFreeMemory(device_, block->memory, nullptr);
}

uint32_t MemoryPool::memoryType(uint32_t allowedTypes, MemoryKind kind) const {
  const Preference preference = preferenceOf(kind);
  for (const VkMemoryPropertyFlags wanted : {preference.required | preference.preferred, preference.required})
    for (uint32_t type = 0; type < properties_.memoryTypeCount; ++type)
      if ((allowedTypes >> type & 1) && (properties_.memoryTypes[type].propertyFlags & wanted) == wanted)
        return type;
  throw RuntimeFailure("the Vulkan device \"" + deviceName_ + "\" has no memory of a kind that is needed");
}

MemoryBlock& MemoryPool::newBlock(uint32_t type, VkDeviceSize size, MemoryKind kind,
                                  const std::string& name) {
  auto flags = structure<VkMemoryAllocateFlagsInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO);
  flags.flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT;
  auto info = structure<VkMemoryAllocateInfo>(VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO);
  info.pNext = &flags;
  info.memoryTypeIndex = type;
  // A heap's size is asked first: software drivers would hand out address space that is not there.
  const VkDeviceSize heapBytes = properties_.memoryHeaps[properties_.memoryTypes[type].heapIndex].size;
  VkDeviceMemory memory = VK_NULL_HANDLE;
  VkResult result = VK_ERROR_OUT_OF_DEVICE_MEMORY;
  for (const VkDeviceSize bytes : std::array{std::max(size, kBlockBytes), size}) {
    if (result == VK_SUCCESS || usedBytes_ + bytes > heapBytes) continue;
    info.allocationSize = bytes;
    result = vkAllocateMemory(device_, &info, nullptr, &memory);
  }
  if (result == VK_ERROR_OUT_OF_DEVICE_MEMORY || result == VK_ERROR_OUT_OF_HOST_MEMORY)
    throw RuntimeFailure("out of memory on \"" + deviceName_ + "\": " + std::to_string(size) +
                         " bytes asked for \"" + name + "\", " + std::to_string(usedBytes_) +
                         " in use; make the scene or its textures smaller");
  check(result, "allocating memory for \"" + name + "\"");

  auto block = std::make_unique<MemoryBlock>();
  block->memory = memory;
  block->size = info.allocationSize;
  block->type = type;
  block->kind = kind;
  block->free[0] = block->size;
  MemoryBlock& added = *blocks_.emplace_back(std::move(block));
  if (kind != MemoryKind::device) {
    void* mapped = nullptr;
    check(vkMapMemory(device_, memory, 0, VK_WHOLE_SIZE, 0, &mapped), "mapping memory for \"" + name + "\"");
    added.mapped = static_cast<std::byte*>(mapped);
  }
  return added;
}

Allocation MemoryPool::allocate(const VkMemoryRequirements& requirements, MemoryKind kind,
                                const std::string& name) {
  const std::lock_guard lock(use_);
  const uint32_t type = memoryType(requirements.memoryTypeBits, kind);
  // Buffers and images share blocks, so both keep the granularity between the two.
  const VkDeviceSize alignment = std::max(requirements.alignment, granularity_);
  const VkDeviceSize size = (requirements.size + granularity_ - 1) / granularity_ * granularity_;
  MemoryBlock* holder = nullptr;
  std::optional<VkDeviceSize> offset;
  for (const auto& block : blocks_) {
    if (block->type != type || block->kind != kind) continue;
    holder = block.get();
    offset = holder->take(size, alignment);
    if (offset) break;
  }
  if (!offset) {
    holder = &newBlock(type, size, kind, name);
    offset = holder->take(size, alignment);
  }
  usedBytes_ += size;
  ++allocationCount_;
  return {holder, holder->memory, *offset, size, holder->mapped ? holder->mapped + *offset : nullptr};
}

uint64_t MemoryPool::usedBytes() const {
  const std::lock_guard lock(use_);
  return usedBytes_;
}

uint64_t MemoryPool::allocationCount() const {
  const std::lock_guard lock(use_);
  return allocationCount_;
}

void MemoryPool::release(const Allocation& allocation) {
  const std::lock_guard lock(use_);
  usedBytes_ -= allocation.size;
  --allocationCount_;
  allocation.block->giveBack(allocation.offset, allocation.size);
  if (allocation.block->free.begin()->second != allocation.block->size) return;
  const auto empty = std::ranges::find(blocks_, allocation.block, &std::unique_ptr<MemoryBlock>::get);
  vkFreeMemory(device_, (*empty)->memory, nullptr);
  blocks_.erase(empty);
}

}  // namespace nephroid::gpu
