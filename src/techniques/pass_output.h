// What a pass leaves behind, for who wants to look at it.
#pragma once

#include <string>
#include <vector>

#include "core/shared_language.h"
#include "gpu/resources.h"
#include "techniques/show_data.h"

namespace nephroid {

struct PassOutput {
  std::string pass;  // as the frame's times name it
  std::string name;  // "normals"
  const gpu::Image* image = nullptr;
  uint32_t meaning = kShowPicture;
  float scale = 1;  // as ShowConstants has it
};

}  // namespace nephroid
