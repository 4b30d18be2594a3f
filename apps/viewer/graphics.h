// Everything that the viewer keeps on the Vulkan device. It is created again when the device is lost.
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

  // Draws the panels with their pictures, and shows the result in the window. `framebufferSize`: pixels.
  void show(uvec2 framebufferSize);

  // What the window shows.
  ByteImage screenPicture();

  // Creates again everything that draws the scene, with the present shaders. Where that fails it throws, and
  // nothing has changed.
  void remakePrograms();

  // Sends a picture that the host made to the device; `uploaded` is its image.
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
  // Draws the scene; null until the scene is prepared. Declared last, so that it is destroyed before the
  // device.
  std::unique_ptr<Stage> stage;
};

}  // namespace nephroid
