// Records pictures as a video, with the program ffmpeg.
#pragma once

#include <cstdio>
#include <filesystem>

#include "core/image.h"
#include "core/shared_language.h"

namespace nephroid {

class VideoPipe {
 public:
  // Throws RuntimeFailure, which tells what to install, where there is no ffmpeg. `size`: pixels.
  VideoPipe(const std::filesystem::path& file, uvec2 size, double framesPerSecond);
  // Ends the video.
  ~VideoPipe();
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;

  uvec2 size() const { return size_; }
  // Adds a picture (3 components, of that size). Returns false where ffmpeg has ended.
  bool add(const ByteImage& picture);

 private:
  uvec2 size_;
  std::FILE* pipe_ = nullptr;
};

}  // namespace nephroid
