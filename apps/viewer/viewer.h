// The interactive viewer: a window in which light, glass, water and camera are moved by hand.
#pragma once

#include <filesystem>
#include <string>

#include "core/shared_language.h"
#include "render/settings.h"

namespace nephroid {

struct ViewerOptions {
  std::filesystem::path scene;  // empty: none yet
  PictureSettings settings;
  uvec2 size{0};                // of the picture, pixels; 0: as the window was left last
  double time = 0;              // s
  std::string device;           // as gpu::DeviceOptions has it
  uint32_t frames = 0;          // so many, each made anew, and the end; 0: until the window is closed
  std::filesystem::path stats;  // of those frames; empty: none
};

// Until the window is closed. Throws InputError where there is no display, or this program was built without
// what windows need.
void runViewer(const ViewerOptions& options);

}  // namespace nephroid
