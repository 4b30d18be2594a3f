// Shows images in a window. They are drawn elsewhere and copied to the window.
#pragma once

#include <vector>

#include "core/shared_language.h"
#include "gpu/resources.h"

namespace nephroid::gpu {

enum class Pace { screen, none };  // screen: wait for the screen's refresh; none: show each image at once

class Swapchain {
 public:
  // `surface` belongs to the device's instance; this object takes ownership. The device must outlive this
  // object. Throws RuntimeFailure where the device cannot show images on the surface.
  Swapchain(Device& device, VkSurfaceKHR surface, Pace pace);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  // Copies `image` (rgba8) to the window of `windowSize` pixels and shows it. Returns false where it was not
  // shown: the window has no area, or its size has just changed. The next call uses the new size.
  bool show(const Image& image, uvec2 windowSize);

 private:
  void choosePace(Pace pace);
  void create(uvec2 windowSize);
  void destroy();
  void record(CommandList& commands, const Image& from, VkImage to) const;

  Device& device_;
  VkSurfaceKHR surface_;
  VkSurfaceFormatKHR format_{};
  VkPresentModeKHR mode_ = VK_PRESENT_MODE_FIFO_KHR;
  VkFence acquired_ = VK_NULL_HANDLE;
  VkSwapchainKHR handle_ = VK_NULL_HANDLE;
  std::vector<VkImage> images_;
  uvec2 windowSize_{0};  // for which the images were made
  uvec2 size_{0};        // of the images
  bool isOutdated_ = true;
};

}  // namespace nephroid::gpu
