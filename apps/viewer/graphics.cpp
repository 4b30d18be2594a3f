#include "graphics.h"

namespace nephroid {

Graphics::Graphics(DesktopWindow& window, const ViewerOptions& options)
    : device_({.device = options.device, .surfaceExtensions = DesktopWindow::surfaceExtensions()}),
      swapchain_(device_, window.createSurface(device_.instance()),
                 options.frames > 0 ? gpu::Pace::none : gpu::Pace::screen),
      gui_(device_, window) {}

void Graphics::show(uvec2 framebufferSize) {
  if (!screen_ || uvec2(screen_.width(), screen_.height()) != framebufferSize)
    screen_ = gpu::createImage(
        device_, "screen",
        {.format = VK_FORMAT_R8G8B8A8_UNORM, .width = framebufferSize.x, .height = framebufferSize.y});
  gui_.draw(screen_);
  swapchain_.show(screen_, framebufferSize);
}

}  // namespace nephroid
