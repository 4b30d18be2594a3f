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

  // What Vulkan needs to show pictures in windows here.
  static std::vector<std::string> surfaceExtensions();
  // Throws RuntimeFailure.
  VkSurfaceKHR createSurface(VkInstance instance) const;

  // Waits at most so long (s; 0: not at all) for something to happen.
  Input poll(double seconds);

  uvec2 framebufferSize() const;  // pixels; 0 while minimised
  uvec2 size() const;             // in the desktop's units
  ivec2 position() const;
  float contentScale() const;  // pixels that the user wants for one of an ordinary screen
  bool isHeld(int key) const;
  bool isClosing() const;
  void setClosing(bool isClosing);
  void setTitle(const std::string& title);
  void place(ivec2 position);
  void resize(uvec2 size);
  // So that it is so many pixels, and waits a moment for it; the desktop may have it otherwise.
  void resizeFramebuffer(uvec2 pixels);
  GLFWwindow* handle() const { return window_; }

 private:
  void listen();

  GLFWwindow* window_ = nullptr;
  Input input_;  // being collected
  vec2 lastMouse_{0};
  std::string title_;
};

}  // namespace nephroid
