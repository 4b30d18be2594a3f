#include "viewer/video_pipe.h"

#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <sstream>
#include <string>

#include "core/error.h"

namespace nephroid {
namespace {

bool isInPath(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access((std::filesystem::path(folder) / program).c_str(), X_OK) == 0) return true;
  return false;
}

std::string quotedForShell(const std::string& text) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return result + "'";
}

}  // namespace

VideoPipe::VideoPipe(const std::filesystem::path& file, uvec2 size, double framesPerSecond) : size_(size) {
  if (!isInPath("ffmpeg"))
    throw RuntimeFailure("there is no ffmpeg to record videos with: install package ffmpeg");
  std::signal(SIGPIPE, SIG_IGN);  // a write says that ffmpeg is gone
  std::ostringstream command;
  command << "exec ffmpeg -loglevel error -y -f rawvideo -pix_fmt rgb24 -s " << size.x << 'x' << size.y
          << " -r "
          << framesPerSecond
          // Players want even sizes.
          << " -i - -vf 'crop=trunc(iw/2)*2:trunc(ih/2)*2' -pix_fmt yuv420p "
          << quotedForShell(file.string());
  pipe_ = popen(command.str().c_str(), "w");
  if (!pipe_) throw RuntimeFailure("ffmpeg could not be started");
}

VideoPipe::~VideoPipe() {
  pclose(pipe_);
}

bool VideoPipe::add(const ByteImage& picture) {
  return std::fwrite(picture.bytes.data(), 1, picture.bytes.size(), pipe_) == picture.bytes.size() &&
         std::fflush(pipe_) == 0;
}

}  // namespace nephroid
