#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <sstream>

#include "core/error.h"
#include "core/hash.h"
#include "transport/table/table_file.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kCacheBytes = uint64_t{2} << 30;
constexpr const char* kExtension = ".table";

fs::path cacheFile(const fs::path& folder, const TableKey& key) {
  Hasher hasher;
  hasher.add(key.geometry);
  for (int channel = 0; channel < 3; ++channel) hasher.add(key.ior[channel]);
  for (const uint32_t count : {key.vertices, key.rings, key.azimuths}) hasher.add(count);
  std::ostringstream name;
  name << std::hex << std::setfill('0') << std::setw(16) << hasher.value() << kExtension;
  return folder / name.str();
}

void touch(const fs::path& file) {
  std::error_code ignored;
  fs::last_write_time(file, fs::file_time_type::clock::now(), ignored);
}

// Removes the least recently used tables until the rest fit. Another process may be doing the same.
void trimCache(const fs::path& folder) {
  struct Cached {
    fs::file_time_type used;
    uint64_t bytes;
    fs::path file;
  };
  std::vector<Cached> tables;
  uint64_t total = 0;
  std::error_code error;
  for (fs::directory_iterator entry(folder, error), end; !error && entry != end; entry.increment(error)) {
    if (entry->path().extension() != kExtension) continue;
    std::error_code timeError;
    std::error_code sizeError;
    const Cached cached{entry->last_write_time(timeError), entry->file_size(sizeError), entry->path()};
    if (timeError || sizeError) continue;
    total += cached.bytes;
    tables.push_back(cached);
  }
  std::sort(tables.begin(), tables.end(), [](const Cached& a, const Cached& b) { return a.used < b.used; });
  for (const Cached& oldest : tables) {
    if (total <= kCacheBytes) return;
    if (fs::remove(oldest.file, error)) total -= oldest.bytes;
  }
}

void keep(const TransportTable& table, const fs::path& folder, const fs::path& file) {
  if (table.sizeInBytes() > kCacheBytes) return;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  try {
    writeTables({&table, 1}, file);
    trimCache(folder);
  } catch (const RuntimeFailure&) {
    // A folder that cannot be written costs a build the next time and nothing else.
  }
}

}  // namespace

fs::path tableCacheFolder() {
  // The XDG base directory specification has relative paths ignored.
  const char* cache = std::getenv("XDG_CACHE_HOME");
  if (cache && fs::path(cache).is_absolute()) return fs::path(cache) / "nephroid";
  const char* home = std::getenv("HOME");
  if (home && fs::path(home).is_absolute()) return fs::path(home) / ".cache" / "nephroid";
  return {};
}

TransportTable loadOrBuildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress,
                                const fs::path& cacheFolder) {
  if (cacheFolder.empty()) return buildTable(mesh, ior, settings, progress);
  const TableKey key = tableKey(mesh, ior, settings);
  const fs::path file = cacheFile(cacheFolder, key);
  try {
    TransportTable table = openTables(file, {&key, 1})[0];
    touch(file);
    return table;
  } catch (const std::runtime_error&) {
    // Not there yet, or no longer usable: built below.
  }
  TransportTable table = buildTable(mesh, ior, settings, progress);
  keep(table, cacheFolder, file);
  return table;
}

}  // namespace nephroid
