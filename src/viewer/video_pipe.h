// Pictures to a video, by way of ffmpeg.
#pragma once

#include <cstdio>
#include <filesystem>

#include "core/image.h"
#include "core/shared_language.h"

namespace nephroid {

class VideoPipe {
 public:
  // Throws RuntimeFailure, saying what to install, where there is no ffmpeg.
  VideoPipe(const std::filesystem::path& file, uvec2 size, double framesPerSecond);
  // Ends the video.
  ~VideoPipe();
  VideoPipe(const VideoPipe&) = delete;
  VideoPipe& operator=(const VideoPipe&) = delete;

  uvec2 size() const { return size_; }
  // RGB, of that size. False where ffmpeg takes no more.
  bool add(const ByteImage& picture);

 private:
  uvec2 size_;
  std::FILE* pipe_ = nullptr;
};

}  // namespace nephroid
