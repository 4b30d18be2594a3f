// What keys and mouse do: the list that help is made of, and that keys are looked up in.
#pragma once

#include <span>

namespace nephroid {

class Viewer;

struct KeyBinding {
  const char* shown;  // "Ctrl S"
  const char* help;
  int key = 0;  // GLFW_KEY_..., which for a letter means the key that has it on the user's keyboard; 0: the
                // mouse does it, or it is held
  bool isControl = false;
  bool isShift = false;
  void (*act)(Viewer&) = nullptr;
  bool repeats = false;  // while the key is held
};

std::span<const KeyBinding> keyBindings();

}  // namespace nephroid
