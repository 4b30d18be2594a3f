#include "gpu/resources.h"

#include <algorithm>
#include <stdexcept>

#include "core/error.h"
#include "gpu/command_list.h"

namespace nephroid::gpu {

Buffer::~Buffer() {
  if (!handle_) return;
  vkDestroyBuffer(device_->handle(), handle_, nullptr);
  if (allocation_.block) device_->memory().release(allocation_);
}

void Buffer::swap(Buffer& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(handle_, other.handle_);
  std::swap(address_, other.address_);
  std::swap(size_, other.size_);
  std::swap(allocation_, other.allocation_);
  std::swap(name_, other.name_);
}

void Buffer::writeBytes(std::span<const std::byte> bytes, VkDeviceSize byteOffset) const {
  if (!mapped() || byteOffset + bytes.size() > size_)
    throw std::logic_error("writing " + std::to_string(bytes.size()) + " bytes outside of buffer " + name_);
  if (!bytes.empty()) std::memcpy(mapped() + byteOffset, bytes.data(), bytes.size());
}

Buffer createBuffer(Device& device, const std::string& name, VkDeviceSize bytes, MemoryKind kind) {
  Buffer buffer;
  buffer.device_ = &device;
  buffer.name_ = name;
  buffer.size_ = std::max<VkDeviceSize>(bytes, 16);
  auto info = structure<VkBufferCreateInfo>(VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO);
  info.size = buffer.size_;
  info.usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT |
               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT |
               VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
  const std::string what = std::to_string(bytes) + " bytes of buffer \"" + name + "\"";
  check(vkCreateBuffer(device.handle(), &info, nullptr, &buffer.handle_), "creating " + what);
  device.setName(VK_OBJECT_TYPE_BUFFER, reinterpret_cast<uint64_t>(buffer.handle_), name);

  VkMemoryRequirements requirements;
  vkGetBufferMemoryRequirements(device.handle(), buffer.handle_, &requirements);
  buffer.allocation_ = device.memory().allocate(requirements, kind, name);
  check(vkBindBufferMemory(device.handle(), buffer.handle_, buffer.allocation_.memory,
                           buffer.allocation_.offset),
        "binding memory to " + what);
  auto address = structure<VkBufferDeviceAddressInfo>(VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO);
  address.buffer = buffer.handle_;
  buffer.address_ = vkGetBufferDeviceAddress(device.handle(), &address);
  return buffer;
}

void ensureBuffer(Device& device, Buffer& buffer, const std::string& name, VkDeviceSize bytes,
                  MemoryKind kind) {
  if (buffer && buffer.size() >= bytes) return;
  constexpr VkDeviceSize kMostSpare = 32 << 20;
  buffer = {};
  buffer = createBuffer(device, name, bytes + std::min(bytes / 2, kMostSpare), kind);
}

Image::~Image() {
  if (!handle_) return;
  for (const VkImageView view : layerViews_) vkDestroyImageView(device_->handle(), view, nullptr);
  for (const VkImageView view : levelViews_) vkDestroyImageView(device_->handle(), view, nullptr);
  if (view_) vkDestroyImageView(device_->handle(), view_, nullptr);
  vkDestroyImage(device_->handle(), handle_, nullptr);
  if (allocation_.block) device_->memory().release(allocation_);
}

void Image::swap(Image& other) noexcept {
  std::swap(device_, other.device_);
  std::swap(handle_, other.handle_);
  std::swap(view_, other.view_);
  std::swap(levelViews_, other.levelViews_);
  std::swap(layerViews_, other.layerViews_);
  std::swap(options_, other.options_);
  std::swap(aspect_, other.aspect_);
  std::swap(usage_, other.usage_);
  std::swap(allocation_, other.allocation_);
  std::swap(name_, other.name_);
}

VkImageView Image::createView(VkImageViewType type, uint32_t layer, uint32_t layers, uint32_t levels) const {
  auto info = structure<VkImageViewCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO);
  info.image = handle_;
  info.viewType = type;
  info.format = options_.format;
  info.subresourceRange = {aspect_, 0, levels, layer, layers};
  VkImageView view = VK_NULL_HANDLE;
  check(vkCreateImageView(device_->handle(), &info, nullptr, &view),
        "creating a view of image \"" + name_ + "\"");
  return view;
}

namespace {

bool isDepthFormat(VkFormat format) {
  return format == VK_FORMAT_D32_SFLOAT || format == VK_FORMAT_D16_UNORM ||
         format == VK_FORMAT_X8_D24_UNORM_PACK32;
}

VkImageUsageFlags usageOf(Device& device, VkFormat format) {
  VkFormatProperties properties;
  vkGetPhysicalDeviceFormatProperties(device.physicalDevice(), format, &properties);
  const VkFormatFeatureFlags can = properties.optimalTilingFeatures;
  VkImageUsageFlags usage = VK_IMAGE_USAGE_TRANSFER_SRC_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  if (can & VK_FORMAT_FEATURE_SAMPLED_IMAGE_BIT) usage |= VK_IMAGE_USAGE_SAMPLED_BIT;
  if (can & VK_FORMAT_FEATURE_STORAGE_IMAGE_BIT) usage |= VK_IMAGE_USAGE_STORAGE_BIT;
  if (can & VK_FORMAT_FEATURE_COLOR_ATTACHMENT_BIT) usage |= VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT;
  if (can & VK_FORMAT_FEATURE_DEPTH_STENCIL_ATTACHMENT_BIT)
    usage |= VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT;
  return usage;
}

void refuseTooLarge(Device& device, const VkImageCreateInfo& info, const std::string& name) {
  VkImageFormatProperties most{};
  const VkResult result = vkGetPhysicalDeviceImageFormatProperties(
      device.physicalDevice(), info.format, info.imageType, info.tiling, info.usage, info.flags, &most);
  const auto sizeText = [](uint32_t width, uint32_t height, uint32_t layers) {
    return std::to_string(width) + "x" + std::to_string(height) + "x" + std::to_string(layers);
  };
  if (result == VK_ERROR_FORMAT_NOT_SUPPORTED)
    throw RuntimeFailure("\"" + device.info().name + "\" lacks the format " + std::to_string(info.format) +
                         " of image \"" + name + "\"");
  check(result, "asking about image \"" + name + "\"");
  if (info.extent.width > most.maxExtent.width || info.extent.height > most.maxExtent.height ||
      info.arrayLayers > most.maxArrayLayers)
    throw RuntimeFailure("image \"" + name + "\" of " +
                         sizeText(info.extent.width, info.extent.height, info.arrayLayers) +
                         " is larger than \"" + device.info().name + "\" can make (" +
                         sizeText(most.maxExtent.width, most.maxExtent.height, most.maxArrayLayers) + ")");
}

}  // namespace

Image createImage(Device& device, const std::string& name, const ImageOptions& options) {
  Image image;
  image.device_ = &device;
  image.name_ = name;
  image.options_ = options;
  image.aspect_ = isDepthFormat(options.format) ? VK_IMAGE_ASPECT_DEPTH_BIT : VK_IMAGE_ASPECT_COLOR_BIT;
  image.usage_ = usageOf(device, options.format);

  auto info = structure<VkImageCreateInfo>(VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO);
  info.imageType = VK_IMAGE_TYPE_2D;
  info.format = options.format;
  info.extent = {std::max(options.width, 1u), std::max(options.height, 1u), 1};
  info.mipLevels = options.mipLevels;
  info.arrayLayers = image.layerCount();
  info.samples = VK_SAMPLE_COUNT_1_BIT;
  info.tiling = VK_IMAGE_TILING_OPTIMAL;
  info.usage = image.usage_;
  refuseTooLarge(device, info, name);
  check(vkCreateImage(device.handle(), &info, nullptr, &image.handle_), "creating image \"" + name + "\"");
  device.setName(VK_OBJECT_TYPE_IMAGE, reinterpret_cast<uint64_t>(image.handle_), name);

  VkMemoryRequirements requirements;
  vkGetImageMemoryRequirements(device.handle(), image.handle_, &requirements);
  image.allocation_ = device.memory().allocate(requirements, MemoryKind::device, name);
  check(vkBindImageMemory(device.handle(), image.handle_, image.allocation_.memory, image.allocation_.offset),
        "binding memory to image \"" + name + "\"");
  const VkImageViewType type = image.isArray() ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
  image.view_ = image.createView(type, 0, image.layerCount(), options.mipLevels);
  if (options.mipLevels > 1) image.levelViews_.push_back(image.createView(type, 0, image.layerCount(), 1));
  for (uint32_t layer = 0; layer < image.layerCount(); ++layer)
    image.layerViews_.push_back(image.createView(VK_IMAGE_VIEW_TYPE_2D, layer, 1, 1));
  device.submitAndWait([&](CommandList& commands) { commands.toGeneralLayout(image); });
  return image;
}

Sampler::~Sampler() {
  if (device_) vkDestroySampler(device_->handle(), handle_, nullptr);
}

Sampler createSampler(Device& device, const SamplerOptions& options) {
  Sampler sampler;
  auto info = structure<VkSamplerCreateInfo>(VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO);
  info.magFilter = info.minFilter = options.filter;
  info.mipmapMode =
      options.filter == VK_FILTER_LINEAR ? VK_SAMPLER_MIPMAP_MODE_LINEAR : VK_SAMPLER_MIPMAP_MODE_NEAREST;
  info.addressModeU = info.addressModeV = info.addressModeW = options.address;
  info.maxLod = options.mipmapped ? VK_LOD_CLAMP_NONE : 0;
  info.borderColor = options.border;
  info.compareEnable = options.compare.has_value();
  info.compareOp = options.compare.value_or(VK_COMPARE_OP_NEVER);
  check(vkCreateSampler(device.handle(), &info, nullptr, &sampler.handle_), "creating a sampler");
  sampler.device_ = &device;
  return sampler;
}

}  // namespace nephroid::gpu
