// All that the window has on the device. Made anew when the device is lost.
#pragma once

#include <memory>

#include "core/image.h"
#include "gpu/swapchain.h"
#include "gui.h"
#include "viewer.h"
#include "viewer/show/output_view.h"
#include "viewer/stage.h"
#include "window.h"

namespace nephroid {

class Graphics {
 public:
  Graphics(DesktopWindow& window, const ViewerOptions& options);

  gpu::Device& device() { return device_; }
  Gui& gui() { return gui_; }
  OutputView& outputView() { return *outputView_; }

  // Draws the panels, over the pictures among them, and shows all that in the window.
  void show(uvec2 framebufferSize);

  // All that is drawn of the scene, of the shaders as they are now. Throws, and it stays as it was, where
  // they do not fit.
  void remakePrograms();

  // A picture that the host made.
  void upload(const ByteImage& picture);
  const gpu::Image& uploaded() const { return uploaded_; }

 private:
  gpu::Device device_;
  gpu::Swapchain swapchain_;
  Gui gui_;
  std::unique_ptr<OutputView> outputView_;
  gpu::Image screen_;
  gpu::Image uploaded_;

 public:
  // What is drawn of the scene; none until it is prepared. Goes before the device.
  std::unique_ptr<Stage> stage;
};

}  // namespace nephroid
