// The interactive viewer: a window in which light, glass, water and camera are moved by hand.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/shared_language.h"
#include "render/settings.h"

namespace nephroid {

// With the samples of each pixel that a picture at rest has at last.
inline PictureSettings viewerSettings() {
  PictureSettings settings;
  settings.samples.count = 64;
  return settings;
}

struct ViewerOptions {
  std::filesystem::path scene;  // empty: none yet
  PictureSettings settings = viewerSettings();
  uvec2 size{0};    // of the picture, pixels; 0: the size of the last use
  double time = 0;  // s
  ToneChoice tone;
  std::string device;  // as gpu::DeviceOptions::device
  uint32_t frames =
      0;  // draw this many frames, compute each completely, and end; 0: until the window is closed
  std::vector<std::string> shown;  // in place of the picture, or over it: of viewNames()
  // Write what the window shows to this PNG, without panels, and end; empty: do not.
  std::filesystem::path picture;
  bool waitsForFrames = false;  // however long one takes; otherwise the window goes on beside it
  std::filesystem::path stats;  // where to write the figures of those frames; empty: nowhere
};

// Whether it ends without a user, who then has no preferences either.
inline bool endsByItself(const ViewerOptions& options) {
  return options.frames > 0 || !options.picture.empty();
}

// What may be shown in place of the picture, or over it.
std::vector<std::string> viewNames();

// Runs until the window is closed. Throws InputError where there is no display, or where this program was
// built without the viewer's libraries.
void runViewer(const ViewerOptions& options);

}  // namespace nephroid
