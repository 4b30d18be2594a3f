#include "window.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <array>
#include <cstdlib>

#include "core/error.h"

namespace nephroid {
namespace {

constexpr const char* kNoDisplay =
    "there is no display to open a window on; 'nephroid render' makes pictures without one";
constexpr std::array kButtons{GLFW_MOUSE_BUTTON_LEFT, GLFW_MOUSE_BUTTON_RIGHT, GLFW_MOUSE_BUTTON_MIDDLE};

// Once for the program: there is one window.
struct Library {
  Library() {
#ifdef GLFW_PLATFORM
    // Where there is no folder for Wayland's sockets, its library would say so on standard error.
    if (!std::getenv("XDG_RUNTIME_DIR")) glfwInitHint(GLFW_PLATFORM, GLFW_PLATFORM_X11);
#endif
    if (!glfwInit()) throw InputError(kNoDisplay);
  }
  ~Library() {
    glfwTerminate();
  }
  Library(const Library&) = delete;
  Library& operator=(const Library&) = delete;
};

void ensureLibrary() {
  static const Library library;
}

Input& inputOf(GLFWwindow* window) {
  return *static_cast<Input*>(glfwGetWindowUserPointer(window));
}

vec2 pixelsPerUnit(GLFWwindow* window) {
  ivec2 pixels(1), units(1);
  glfwGetFramebufferSize(window, &pixels.x, &pixels.y);
  glfwGetWindowSize(window, &units.x, &units.y);
  return vec2(pixels) / vec2(glm::max(units, ivec2(1)));
}

uint32_t characterOn(int key, int scancode) {
  const char* name = glfwGetKeyName(key, scancode);
  return name && name[0] != 0 && name[1] == 0 ? static_cast<unsigned char>(name[0]) : 0;
}

void onKey(GLFWwindow* window, int key, int scancode, int action, int modifiers) {
  Input& input = inputOf(window);
  input.isAny = true;
  if (action == GLFW_PRESS || action == GLFW_REPEAT)
    input.presses.push_back({key, characterOn(key, scancode), (modifiers & GLFW_MOD_SHIFT) != 0,
                             (modifiers & GLFW_MOD_CONTROL) != 0, action == GLFW_REPEAT});
}

void onButton(GLFWwindow* window, int button, int action, int) {
  Input& input = inputOf(window);
  input.isAny = true;
  if (action == GLFW_PRESS) input.takenAt = input.mouse;
  for (std::size_t i = 0; i < kButtons.size(); ++i)
    if (kButtons[i] == button) {
      (action == GLFW_PRESS ? input.wentDown : input.wentUp)[i] = true;
      input.isDown[i] = action == GLFW_PRESS;
    }
}

}  // namespace

DesktopWindow::DesktopWindow(const std::string& title, uvec2 size) : title_(title) {
  ensureLibrary();
  if (!glfwVulkanSupported())
    throw InputError("windows cannot show Vulkan's pictures here; update libvulkan1");
  glfwDefaultWindowHints();
  glfwWindowHint(GLFW_CLIENT_API, GLFW_NO_API);
  window_ =
      glfwCreateWindow(static_cast<int>(size.x), static_cast<int>(size.y), title.c_str(), nullptr, nullptr);
  if (!window_) throw InputError(kNoDisplay);
  glfwSetWindowSizeLimits(window_, 320, 240, GLFW_DONT_CARE, GLFW_DONT_CARE);
  listen();
}

DesktopWindow::~DesktopWindow() {
  glfwDestroyWindow(window_);
}

void DesktopWindow::listen() {
  glfwSetWindowUserPointer(window_, &input_);
  glfwSetKeyCallback(window_, onKey);
  glfwSetMouseButtonCallback(window_, onButton);
  glfwSetScrollCallback(window_, [](GLFWwindow* window, double, double steps) {
    inputOf(window).wheel += static_cast<float>(steps);
    inputOf(window).isAny = true;
  });
  glfwSetCursorPosCallback(window_, [](GLFWwindow* window, double x, double y) {
    inputOf(window).isAny = true;
    inputOf(window).mouse = vec2(x, y) * pixelsPerUnit(window);
  });
  // The one key that is a character wherever it is on the keyboard.
  glfwSetCharCallback(window_, [](GLFWwindow* window, unsigned character) {
    inputOf(window).isAny = true;
    if (character == '?') inputOf(window).presses.push_back({.key = GLFW_KEY_F1});
  });
  glfwSetFramebufferSizeCallback(window_, [](GLFWwindow* window, int, int) { inputOf(window).isAny = true; });
  glfwSetWindowRefreshCallback(window_, [](GLFWwindow* window) { inputOf(window).isAny = true; });
  glfwSetWindowCloseCallback(window_, [](GLFWwindow* window) { inputOf(window).isAny = true; });
  glfwSetDropCallback(window_, [](GLFWwindow* window, int count, const char** paths) {
    Input& input = inputOf(window);
    input.isAny = true;
    for (int i = 0; i < count; ++i) input.dropped.emplace_back(paths[i]);
  });
}

std::vector<std::string> DesktopWindow::surfaceExtensions() {
  ensureLibrary();
  uint32_t count = 0;
  const char** names = glfwGetRequiredInstanceExtensions(&count);
  if (!names) throw InputError("windows cannot show Vulkan's pictures here; update libvulkan1");
  return {names, names + count};
}

VkSurfaceKHR DesktopWindow::createSurface(VkInstance instance) const {
  // GLFW declares it only where a Vulkan header, which volk stands in for, comes before it.
  VkSurfaceKHR surface = VK_NULL_HANDLE;
  gpu::check(glfwCreateWindowSurface(instance, window_, nullptr, &surface),
             "opening the window to the device");
  return surface;
}

Input DesktopWindow::poll(double seconds) {
  if (seconds > 0)
    glfwWaitEventsTimeout(seconds);
  else
    glfwPollEvents();
  input_.moved = input_.mouse - lastMouse_;
  lastMouse_ = input_.mouse;
  input_.isShift = isHeld(GLFW_KEY_LEFT_SHIFT) || isHeld(GLFW_KEY_RIGHT_SHIFT);
  input_.isControl = isHeld(GLFW_KEY_LEFT_CONTROL) || isHeld(GLFW_KEY_RIGHT_CONTROL);
  input_.heldAxis = -1;
  for (int axis = 0; axis < 3; ++axis)
    if (isHeld(GLFW_KEY_X + axis)) input_.heldAxis = axis;
  const Input collected = input_;
  input_.presses.clear();
  input_.dropped.clear();
  input_.wheel = 0;
  input_.isAny = false;
  std::ranges::fill(input_.wentDown, false);
  std::ranges::fill(input_.wentUp, false);
  return collected;
}

uvec2 DesktopWindow::framebufferSize() const {
  if (glfwGetWindowAttrib(window_, GLFW_ICONIFIED)) return uvec2(0);
  ivec2 pixels(0);
  glfwGetFramebufferSize(window_, &pixels.x, &pixels.y);
  return uvec2(glm::max(pixels, ivec2(0)));
}

uvec2 DesktopWindow::size() const {
  ivec2 units(0);
  glfwGetWindowSize(window_, &units.x, &units.y);
  return uvec2(glm::max(units, ivec2(0)));
}

ivec2 DesktopWindow::position() const {
  ivec2 units(0);
  glfwGetWindowPos(window_, &units.x, &units.y);
  return units;
}

float DesktopWindow::contentScale() const {
  float x = 1, y = 1;
  glfwGetWindowContentScale(window_, &x, &y);
  return glm::clamp(std::max(x, y), 0.5f, 4.0f);
}

bool DesktopWindow::isHeld(int key) const {
  return glfwGetKey(window_, key) == GLFW_PRESS;
}

bool DesktopWindow::isClosing() const {
  return glfwWindowShouldClose(window_) != 0;
}

void DesktopWindow::setClosing(bool isClosing) {
  glfwSetWindowShouldClose(window_, isClosing);
}

void DesktopWindow::setTitle(const std::string& title) {
  if (title == title_) return;
  title_ = title;
  glfwSetWindowTitle(window_, title.c_str());
}

void DesktopWindow::place(ivec2 position) {
  glfwSetWindowPos(window_, position.x, position.y);
}

void DesktopWindow::resize(uvec2 size) {
  glfwSetWindowSize(window_, static_cast<int>(size.x), static_cast<int>(size.y));
}

void DesktopWindow::resizeFramebuffer(uvec2 pixels) {
  if (framebufferSize() == pixels) return;
  resize(uvec2(glm::round(vec2(pixels) / pixelsPerUnit(window_))));
  for (int i = 0; i < 50 && framebufferSize() != pixels; ++i) glfwWaitEventsTimeout(0.02);
}

}  // namespace nephroid
