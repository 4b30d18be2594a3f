// What keys and mouse do. The help page shows this list, and pressed keys are looked up in it.
#pragma once

#include <span>

namespace nephroid {

class Viewer;

struct KeyBinding {
  const char* shown;  // "Ctrl S"
  const char* help;
  int key = 0;  // GLFW_KEY_...; for a letter, the key with this letter in the user's layout; 0: an action of
                // the mouse, or of a key that is held
  bool isControl = false;
  bool isShift = false;
  void (*act)(Viewer&) = nullptr;
  bool repeats = false;  // again and again while the key is held
};

std::span<const KeyBinding> keyBindings();

}  // namespace nephroid
