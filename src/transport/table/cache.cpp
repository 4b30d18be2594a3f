#include <iomanip>
#include <sstream>

#include "core/cache_folder.h"
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

void keep(const TransportTable& table, const fs::path& folder, const fs::path& file) {
  if (table.sizeInBytes() > kCacheBytes) return;
  std::error_code ignored;
  fs::create_directories(folder, ignored);
  try {
    writeTables({&table, 1}, file);
    trimCache(folder, kExtension, kCacheBytes);
  } catch (const RuntimeFailure&) {
    // A folder that cannot be written costs a build the next time and nothing else.
  }
}

}  // namespace

TransportTable loadOrBuildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress,
                                const fs::path& folder) {
  if (folder.empty()) return buildTable(mesh, ior, settings, progress);
  const TableKey key = tableKey(mesh, ior, settings);
  const fs::path file = cacheFile(folder, key);
  try {
    TransportTable table = openTables(file, {&key, 1})[0];
    touchCached(file);
    return table;
  } catch (const std::runtime_error&) {
    // Not there yet, or no longer usable: built below.
  }
  TransportTable table = buildTable(mesh, ior, settings, progress);
  keep(table, folder, file);
  return table;
}

}  // namespace nephroid
