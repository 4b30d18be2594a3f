// Buffers, images and samplers. They can be moved but not copied, and must be destroyed before their Device.
// Names appear in validation messages, captures and out-of-memory errors.
#pragma once

#include <cstddef>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "gpu/device.h"

namespace nephroid::gpu {

class Buffer {
 public:
  Buffer() = default;
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Buffer();

  VkBuffer handle() const { return handle_; }
  // For buffer references in shaders; aligned to at least 16 bytes.
  VkDeviceAddress address() const { return address_; }
  VkDeviceSize size() const { return size_; }  // bytes
  const std::string& name() const { return name_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

  // Mapped memory (upload and readback only). The device uses it only during submitAndWait.
  std::byte* mapped() const { return allocation_.mapped; }
  template <class T>
  std::span<T> as() const {
    return {reinterpret_cast<T*>(mapped()), size_ / sizeof(T)};
  }
  template <class T>
  void write(std::span<const T> values, VkDeviceSize byteOffset = 0) const {
    writeBytes(std::as_bytes(values), byteOffset);
  }
  template <class T>
  void write(const std::vector<T>& values, VkDeviceSize byteOffset = 0) const {
    writeBytes(std::as_bytes(std::span(values)), byteOffset);
  }
  void writeBytes(std::span<const std::byte> bytes, VkDeviceSize byteOffset) const;

 private:
  friend Buffer createBuffer(Device&, const std::string&, VkDeviceSize, MemoryKind);
  void swap(Buffer& other) noexcept;

  Device* device_ = nullptr;
  VkBuffer handle_ = VK_NULL_HANDLE;
  VkDeviceAddress address_ = 0;
  VkDeviceSize size_ = 0;
  Allocation allocation_;
  std::string name_;
};

// `bytes` of zero makes a buffer of 16, so that an empty list needs no special case. The contents are
// undefined.
Buffer createBuffer(Device& device, const std::string& name, VkDeviceSize bytes,
                    MemoryKind kind = MemoryKind::device);

// Replaces a buffer that is smaller than `bytes` by one that is larger by half, and by 32 MiB at most, so
// that a buffer that grows a little with each frame is not allocated in each. The contents are not kept.
void ensureBuffer(Device& device, Buffer& buffer, const std::string& name, VkDeviceSize bytes,
                  MemoryKind kind = MemoryKind::device);

struct ImageOptions {
  VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
  uint32_t width = 1;
  uint32_t height = 1;
  uint32_t layers = 0;  // 0: a plain 2D image; else a 2D array (sampler2DArray, image2DArray) of that many
  uint32_t mipLevels = 1;
};

// An image. It is always in the layout GENERAL, and has all usages that its format allows: sampling, storing,
// rendering, copying.
class Image {
 public:
  Image() = default;
  Image(Image&& other) noexcept { swap(other); }
  Image& operator=(Image&& other) noexcept {
    swap(other);
    return *this;
  }
  ~Image();

  VkImage handle() const { return handle_; }
  VkImageView view() const { return view_; }  // all layers and levels
  // All layers of level 0.
  VkImageView storageView() const { return levelViews_.empty() ? view_ : levelViews_[0]; }
  VkImageView layerView(uint32_t layer) const { return layerViews_[layer]; }  // 2D, level 0: for attachments
  const ImageOptions& options() const { return options_; }
  VkFormat format() const { return options_.format; }
  uint32_t width() const { return options_.width; }
  uint32_t height() const { return options_.height; }
  uint32_t layerCount() const { return options_.layers == 0 ? 1 : options_.layers; }
  bool isArray() const { return options_.layers > 0; }
  VkImageAspectFlags aspect() const { return aspect_; }
  VkImageUsageFlags usage() const { return usage_; }
  const std::string& name() const { return name_; }
  explicit operator bool() const { return handle_ != VK_NULL_HANDLE; }

 private:
  friend Image createImage(Device&, const std::string&, const ImageOptions&);
  void swap(Image& other) noexcept;
  VkImageView createView(VkImageViewType type, uint32_t layer, uint32_t layers, uint32_t levels) const;

  Device* device_ = nullptr;
  VkImage handle_ = VK_NULL_HANDLE;
  VkImageView view_ = VK_NULL_HANDLE;
  std::vector<VkImageView> levelViews_;
  std::vector<VkImageView> layerViews_;
  ImageOptions options_;
  VkImageAspectFlags aspect_ = 0;
  VkImageUsageFlags usage_ = 0;
  Allocation allocation_;
  std::string name_;
};

// Throws RuntimeFailure where the device does not support the format or the size. The contents are undefined.
Image createImage(Device& device, const std::string& name, const ImageOptions& options);

struct SamplerOptions {
  VkFilter filter = VK_FILTER_LINEAR;
  VkSamplerAddressMode address = VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE;
  VkBorderColor border =
      VK_BORDER_COLOR_FLOAT_TRANSPARENT_BLACK;  // for VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_BORDER
  bool mipmapped = false;                       // false: only level 0 is read
  std::optional<VkCompareOp> compare{};         // depth comparison: sampler2DShadow and the like
};

class Sampler {
 public:
  Sampler() = default;
  Sampler(Sampler&& other) noexcept
      : device_(std::exchange(other.device_, nullptr)), handle_(other.handle_) {}
  Sampler& operator=(Sampler&& other) noexcept {
    std::swap(device_, other.device_);
    std::swap(handle_, other.handle_);
    return *this;
  }
  ~Sampler();
  VkSampler handle() const { return handle_; }

 private:
  friend Sampler createSampler(Device&, const SamplerOptions&);
  Device* device_ = nullptr;
  VkSampler handle_ = VK_NULL_HANDLE;
};

Sampler createSampler(Device& device, const SamplerOptions& options = {});

}  // namespace nephroid::gpu
