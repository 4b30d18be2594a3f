// An image that a pass wrote, for the viewer to show.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "core/shared_language.h"
#include "gpu/resources.h"
#include "techniques/show_data.h"

namespace nephroid {

struct ReceiverPoints;

// What the colors of a picture stand for.
struct Legend {
  struct Entry {
    vec3 color{1};  // sRGB
    std::string meaning;
    uint64_t count = 0;  // of what has the color
  };
  std::string title, counted;  // what is shown, and what the counts are of
  std::vector<Entry> entries;
};

struct PassOutput {
  std::string pass;  // as in the frame's times
  std::string name;  // "normals"
  const gpu::Image* image = nullptr;
  uint32_t meaning = kShowPicture;
  float scale = 1;  // as in ShowConstants
  // Where there is no image until it is shown: makes it for the points of receivers that the camera sees. It
  // is valid until the next frame.
  std::function<const gpu::Image*(const ReceiverPoints& points, Legend& legend)> make{};
};

}  // namespace nephroid
