// All that the window has on the device. Made anew when the device is lost.
#pragma once

#include <memory>

#include "gpu/swapchain.h"
#include "gui.h"
#include "viewer.h"
#include "viewer/stage.h"
#include "window.h"

namespace nephroid {

class Graphics {
 public:
  Graphics(DesktopWindow& window, const ViewerOptions& options);

  gpu::Device& device() { return device_; }
  Gui& gui() { return gui_; }

  // Draws the panels over what of the picture lies below them, and shows all that in the window.
  void show(uvec2 framebufferSize);

 private:
  gpu::Device device_;
  gpu::Swapchain swapchain_;
  Gui gui_;
  gpu::Image screen_;

 public:
  // What is drawn of the scene; none until it is prepared. Goes before the device.
  std::unique_ptr<Stage> stage;
};

}  // namespace nephroid
