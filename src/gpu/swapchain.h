// What a window shows: images that are made elsewhere are copied to it.
#pragma once

#include <vector>

#include "core/shared_language.h"
#include "gpu/resources.h"

namespace nephroid::gpu {

enum class Pace { screen, none };  // as often as the screen is drawn; as often as there are images

class Swapchain {
 public:
  // `surface` was made of the device's instance; it is this one's from here on. Throws RuntimeFailure where
  // the device cannot show anything in it. The device outlives it.
  Swapchain(Device& device, VkSurfaceKHR surface, Pace pace);
  ~Swapchain();
  Swapchain(const Swapchain&) = delete;
  Swapchain& operator=(const Swapchain&) = delete;

  // Copies `image` (rgba8) to the window, whose area is `windowSize` pixels, and returns when it is the
  // window's. Nothing is shown in a window without area, and where the window has changed meanwhile; the next
  // call goes on with it as it then is. Returns whether the image was shown.
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
  uvec2 windowSize_{0};  // that it was made for
  uvec2 size_{0};        // of the images
  bool isOutdated_ = true;
};

}  // namespace nephroid::gpu
