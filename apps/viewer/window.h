// A window of the desktop.
#pragma once

#include <string>
#include <vector>

#include "gpu/vulkan.h"
#include "input.h"

struct GLFWwindow;

namespace nephroid {

class DesktopWindow {
 public:
  // Throws InputError, in one line, where there is no display to open a window on.
  DesktopWindow(const std::string& title, uvec2 size);
  ~DesktopWindow();
  DesktopWindow(const DesktopWindow&) = delete;
  DesktopWindow& operator=(const DesktopWindow&) = delete;

  // The Vulkan instance extensions that are needed to show images in a window.
  static std::vector<std::string> surfaceExtensions();
  // Throws RuntimeFailure.
  VkSurfaceKHR createSurface(VkInstance instance) const;

  // Waits at most `seconds` for input, and returns the input since the last call. 0: does not wait.
  Input poll(double seconds);

  uvec2 framebufferSize() const;  // pixels; 0 while minimized
  uvec2 size() const;             // in units of the desktop
  ivec2 position() const;
  float contentScale() const;  // the desktop's scale: 1 on an ordinary screen
  bool isHeld(int key) const;
  bool isClosing() const;
  void setClosing(bool isClosing);
  void setTitle(const std::string& title);
  void place(ivec2 position);
  void resize(uvec2 size);
  // Resizes the window so that its framebuffer has this size, and waits a moment for it. The desktop may
  // choose another size.
  void resizeFramebuffer(uvec2 pixels);
  GLFWwindow* handle() const { return window_; }

 private:
  void listen();

  GLFWwindow* window_ = nullptr;
  Input input_;  // collected since the last poll
  vec2 lastMouse_{0};
  std::string title_;
};

}  // namespace nephroid
