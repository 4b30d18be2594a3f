#include "papers/paper_scenes.h"

#include "core/error.h"
#include "formats/load.h"

namespace nephroid {

std::filesystem::path paperScenes(const PaperBench& bench) {
  if (!bench.scenes.empty()) return bench.scenes;
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path();
  std::string looked;
  for (const char* place : {"../share/nephroid/scenes", "../../scenes", "../../../scenes"}) {
    const auto folder = (program / place).lexically_normal();
    if (std::filesystem::is_regular_file(folder / "glass-ball.toml", error)) return folder;
    looked += (looked.empty() ? "" : ", ") + folder.string();
  }
  throw InputError("the papers' scenes are not there; looked in " + looked +
                   " (name their folder with --scenes)");
}

Scene loadPaper3(const std::filesystem::path& folder, const std::string& name) {
  return loadScene(folder / ("paper3-" + name + ".toml"));
}

}  // namespace nephroid
