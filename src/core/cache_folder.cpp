#include "core/cache_folder.h"

#include <algorithm>
#include <cstdlib>
#include <vector>

namespace nephroid {

namespace fs = std::filesystem;

fs::path cacheFolder() {
  // The XDG base directory specification has relative paths ignored.
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "nephroid";
  const char* home = std::getenv("HOME");
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "nephroid";
  return {};
}

void touchCached(const fs::path& file) {
  std::error_code ignored;
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
}

void trimCache(const fs::path& folder, const std::string& extension, uint64_t bytes) {
  struct Cached {
    fs::file_time_type used;
    uint64_t size;
    fs::path file;
  };
  std::vector<Cached> files;
  uint64_t total = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() != extension) continue;
    std::error_code timeError;
    std::error_code sizeError;
    const Cached cached{entry->last_write_time(timeError), entry->file_size(sizeError), entry->path()};
    if (timeError || sizeError) continue;
    total += cached.size;
    files.push_back(cached);
  }
  std::sort(files.begin(), files.end(), [](const Cached& a, const Cached& b) { return a.used < b.used; });
  for (const Cached& oldest : files) {
    if (total <= bytes) return;
    if (fs::remove(oldest.file, error)) total -= oldest.size;
  }
}

}  // namespace nephroid
