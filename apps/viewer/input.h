// What the user did between two frames, with keys and mouse.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

enum class MouseButton { left, right, middle };
inline constexpr int kMouseButtons = 3;

struct KeyPress {
  int key = 0;        // one of GLFW's constants GLFW_KEY_...
  uint32_t text = 0;  // the character on the key in the user's layout; 0: none
  bool isShift = false;
  bool isControl = false;
  bool isRepeated = false;  // sent again because the key is held
};

struct Input {
  std::vector<KeyPress> presses;  // keys that were pressed, in order
  std::vector<std::filesystem::path> dropped;
  vec2 mouse{0};    // pixels of the framebuffer from the upper left corner
  vec2 moved{0};    // pixels that the mouse moved since the frame before
  vec2 takenAt{0};  // the place, as `mouse`, at which a button was last pressed
  float wheel = 0;  // steps away from the user
  bool isDown[kMouseButtons]{};
  bool wentDown[kMouseButtons]{};
  bool wentUp[kMouseButtons]{};
  bool isShift = false;    // held
  bool isControl = false;  // held
  int heldAxis = -1;       // 0 to 2 while x, y or z is held
  bool isAny = false;      // whether anything happened
};

}  // namespace nephroid
