// What a person did between two frames.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/shared_language.h"

namespace nephroid {

enum class MouseButton { left, right, middle };
inline constexpr int kMouseButtons = 3;

struct KeyPress {
  int key = 0;        // as GLFW_KEY_... has it
  uint32_t text = 0;  // the character on the key in the user's layout; 0: none
  bool isShift = false;
  bool isControl = false;
  bool isRepeated = false;  // held
};

struct Input {
  std::vector<KeyPress> presses;  // keys gone down, in their order
  std::vector<std::filesystem::path> dropped;
  vec2 mouse{0};    // pixels of the framebuffer from the upper left corner
  vec2 moved{0};    // since the frame before
  vec2 takenAt{0};  // as `mouse`, where the button went down that did so last
  float wheel = 0;  // steps away from the user
  bool isDown[kMouseButtons]{};
  bool wentDown[kMouseButtons]{};
  bool wentUp[kMouseButtons]{};
  bool isShift = false;    // held
  bool isControl = false;  // held
  int heldAxis = -1;       // 0 to 2 while x, y or z is held
  bool isAny = false;      // anything happened at all
};

}  // namespace nephroid
