#include "gpu/swapchain.h"

#include <algorithm>

#include "core/error.h"
#include "gpu/command_list.h"

namespace nephroid::gpu {
namespace {

VkSurfaceFormatKHR chosenFormat(VkPhysicalDevice device, VkSurfaceKHR surface) {
  uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, nullptr), "asking for window formats");
  std::vector<VkSurfaceFormatKHR> formats(count);
  check(vkGetPhysicalDeviceSurfaceFormatsKHR(device, surface, &count, formats.data()),
        "asking for window formats");
  // Pictures are encoded already: the bytes are to be shown as they are.
  for (const VkFormat wanted : {VK_FORMAT_B8G8R8A8_UNORM, VK_FORMAT_R8G8B8A8_UNORM})
    for (const VkSurfaceFormatKHR& format : formats)
      if (format.format == wanted) return format;
  throw RuntimeFailure("the Vulkan device has no format of eight bits a channel for this window");
}

void changeLayout(CommandList& commands, VkImage image, VkImageLayout from, VkImageLayout to) {
  auto barrier = structure<VkImageMemoryBarrier2>(VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2);
  barrier.srcStageMask = barrier.dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT;
  barrier.srcAccessMask = barrier.dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT;
  barrier.oldLayout = from;
  barrier.newLayout = to;
  barrier.srcQueueFamilyIndex = barrier.dstQueueFamilyIndex = VK_QUEUE_FAMILY_IGNORED;
  barrier.image = image;
  barrier.subresourceRange = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 1, 0, 1};
  auto dependency = structure<VkDependencyInfo>(VK_STRUCTURE_TYPE_DEPENDENCY_INFO);
  dependency.imageMemoryBarrierCount = 1;
  dependency.pImageMemoryBarriers = &barrier;
  vkCmdPipelineBarrier2(commands.handle(), &dependency);
}

bool isOutOfDate(VkResult result) {
  return result == VK_ERROR_OUT_OF_DATE_KHR || result == VK_ERROR_SURFACE_LOST_KHR;
}

}  // namespace

Swapchain::Swapchain(Device& device, VkSurfaceKHR surface, Pace pace) : device_(device), surface_(surface) {
  VkBool32 isSupported = VK_FALSE;
  check(vkGetPhysicalDeviceSurfaceSupportKHR(device.physicalDevice(), device.queueFamily(), surface,
                                             &isSupported),
        "asking what the window can show");
  if (!isSupported)
    throw RuntimeFailure("the Vulkan device \"" + device.info().name +
                         "\" cannot show pictures in this window");
  format_ = chosenFormat(device.physicalDevice(), surface);
  choosePace(pace);
  const auto fence = structure<VkFenceCreateInfo>(VK_STRUCTURE_TYPE_FENCE_CREATE_INFO);
  check(vkCreateFence(device.handle(), &fence, nullptr, &acquired_), "creating the window's fence");
}

Swapchain::~Swapchain() {
  destroy();
  vkDestroyFence(device_.handle(), acquired_, nullptr);
  vkDestroySurfaceKHR(device_.instance(), surface_, nullptr);
}

void Swapchain::choosePace(Pace pace) {
  if (pace == Pace::screen) return;  // what every device has
  uint32_t count = 0;
  check(vkGetPhysicalDeviceSurfacePresentModesKHR(device_.physicalDevice(), surface_, &count, nullptr),
        "asking for the window's pace");
  std::vector<VkPresentModeKHR> modes(count);
  check(vkGetPhysicalDeviceSurfacePresentModesKHR(device_.physicalDevice(), surface_, &count, modes.data()),
        "asking for the window's pace");
  for (const VkPresentModeKHR wanted : {VK_PRESENT_MODE_MAILBOX_KHR, VK_PRESENT_MODE_IMMEDIATE_KHR})
    if (std::ranges::count(modes, wanted) > 0) mode_ = wanted;
}

void Swapchain::destroy() {
  device_.waitForQueue();
  if (handle_) vkDestroySwapchainKHR(device_.handle(), handle_, nullptr);
  handle_ = VK_NULL_HANDLE;
}

void Swapchain::create(uvec2 windowSize) {
  destroy();
  VkSurfaceCapabilitiesKHR surface;
  check(vkGetPhysicalDeviceSurfaceCapabilitiesKHR(device_.physicalDevice(), surface_, &surface),
        "asking for the window's size");
  const uvec2 least(surface.minImageExtent.width, surface.minImageExtent.height);
  const uvec2 most(surface.maxImageExtent.width, surface.maxImageExtent.height);
  size_ = surface.currentExtent.width == UINT32_MAX
              ? glm::clamp(windowSize, least, most)
              : uvec2(surface.currentExtent.width, surface.currentExtent.height);
  if (size_.x == 0 || size_.y == 0) return;

  auto info = structure<VkSwapchainCreateInfoKHR>(VK_STRUCTURE_TYPE_SWAPCHAIN_CREATE_INFO_KHR);
  info.surface = surface_;
  info.minImageCount =
      std::min(surface.minImageCount + 1, surface.maxImageCount == 0 ? UINT32_MAX : surface.maxImageCount);
  info.imageFormat = format_.format;
  info.imageColorSpace = format_.colorSpace;
  info.imageExtent = {size_.x, size_.y};
  info.imageArrayLayers = 1;
  info.imageUsage = VK_IMAGE_USAGE_TRANSFER_DST_BIT;
  info.imageSharingMode = VK_SHARING_MODE_EXCLUSIVE;
  info.preTransform = surface.currentTransform;
  info.compositeAlpha = (surface.supportedCompositeAlpha & VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR) != 0
                            ? VK_COMPOSITE_ALPHA_OPAQUE_BIT_KHR
                            : VK_COMPOSITE_ALPHA_INHERIT_BIT_KHR;
  info.presentMode = mode_;
  info.clipped = VK_TRUE;
  check(vkCreateSwapchainKHR(device_.handle(), &info, nullptr, &handle_), "creating the window's images");
  uint32_t count = 0;
  check(vkGetSwapchainImagesKHR(device_.handle(), handle_, &count, nullptr),
        "asking for the window's images");
  images_.resize(count);
  check(vkGetSwapchainImagesKHR(device_.handle(), handle_, &count, images_.data()),
        "asking for the window's images");
  windowSize_ = windowSize;
  isOutdated_ = false;
}

void Swapchain::record(CommandList& commands, const Image& from, VkImage to) const {
  commands.barrier();
  changeLayout(commands, to, VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL);
  VkImageBlit blit{};
  blit.srcSubresource = blit.dstSubresource = {VK_IMAGE_ASPECT_COLOR_BIT, 0, 0, 1};
  blit.srcOffsets[1] = {static_cast<int32_t>(from.width()), static_cast<int32_t>(from.height()), 1};
  blit.dstOffsets[1] = {static_cast<int32_t>(size_.x), static_cast<int32_t>(size_.y), 1};
  vkCmdBlitImage(commands.handle(), from.handle(), VK_IMAGE_LAYOUT_GENERAL, to,
                 VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, 1, &blit, VK_FILTER_NEAREST);
  changeLayout(commands, to, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL, VK_IMAGE_LAYOUT_PRESENT_SRC_KHR);
}

bool Swapchain::show(const Image& image, uvec2 windowSize) {
  if (windowSize.x == 0 || windowSize.y == 0) return false;
  if (isOutdated_ || windowSize != windowSize_) create(windowSize);
  if (!handle_) return false;
  uint32_t index = 0;
  const VkResult next =
      vkAcquireNextImageKHR(device_.handle(), handle_, UINT64_MAX, VK_NULL_HANDLE, acquired_, &index);
  if (isOutOfDate(next)) {
    isOutdated_ = true;
    return false;
  }
  if (next != VK_SUBOPTIMAL_KHR) check(next, "asking for an image of the window");
  check(vkWaitForFences(device_.handle(), 1, &acquired_, VK_TRUE, UINT64_MAX), "waiting for the window");
  check(vkResetFences(device_.handle(), 1, &acquired_), "resetting the window's fence");
  device_.submitAndWait([&](CommandList& commands) { record(commands, image, images_[index]); });

  auto present = structure<VkPresentInfoKHR>(VK_STRUCTURE_TYPE_PRESENT_INFO_KHR);
  present.swapchainCount = 1;
  present.pSwapchains = &handle_;
  present.pImageIndices = &index;
  const VkResult shown = device_.present(present);
  isOutdated_ = isOutOfDate(shown) || shown == VK_SUBOPTIMAL_KHR || next == VK_SUBOPTIMAL_KHR;
  if (!isOutdated_) check(shown, "showing an image");
  return !isOutOfDate(shown);
}

}  // namespace nephroid::gpu
