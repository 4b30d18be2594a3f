// An image that a pass wrote, for the viewer to show.
#pragma once

#include <string>
#include <vector>

#include "core/shared_language.h"
#include "gpu/resources.h"
#include "techniques/show_data.h"

namespace nephroid {

struct PassOutput {
  std::string pass;  // as in the frame's times
  std::string name;  // "normals"
  const gpu::Image* image = nullptr;
  uint32_t meaning = kShowPicture;
  float scale = 1;  // as in ShowConstants
};

}  // namespace nephroid
