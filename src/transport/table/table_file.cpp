#include "transport/table/table_file.h"

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <sstream>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/hash.h"
#include "core/mapped_file.h"

namespace nephroid {
namespace {

static_assert(std::endian::native == std::endian::little, "tables are written as they lie in memory");

constexpr char kMagic[8] = {'n', 'e', 'p', 'h', 'L', 'T', 'T', '\n'};
constexpr uint32_t kVersion = 1;  // goes up with every change to what is stored or to how rays are followed

// What each table of a file begins with; its words follow.
struct FileHeader {
  char magic[8];
  uint32_t version;
  uint32_t vertices;
  uint32_t rings;
  uint32_t azimuths;
  vec3 ior;
  float pathScale;
  vec3 boxMinimum;
  uint32_t index;  // of this table in the file
  vec3 boxExtent;
  uint32_t tables;  // in the file
  uint64_t geometry;
  uint64_t wordsHash;
  uint64_t headerHash;  // of all before it
};
static_assert(sizeof(FileHeader) == 96);
static_assert(offsetof(FileHeader, headerHash) == 88);

uint64_t hashOf(const FileHeader& header) {
  return hashBytes(std::as_bytes(std::span(&header, 1)).first(offsetof(FileHeader, headerHash)));
}

FileHeader headerOf(const TransportTable& table, std::size_t index, std::size_t tables) {
  const TableView& view = table.view();
  FileHeader header{};
  std::copy(std::begin(kMagic), std::end(kMagic), header.magic);
  header.version = kVersion;
  header.vertices = table.key().vertices;
  header.rings = table.key().rings;
  header.azimuths = table.key().azimuths;
  header.ior = table.key().ior;
  header.pathScale = view.pathScale;
  header.boxMinimum = view.boxMinimum;
  header.index = static_cast<uint32_t>(index);
  header.boxExtent = view.boxExtent;
  header.tables = static_cast<uint32_t>(tables);
  header.geometry = table.key().geometry;
  header.wordsHash = hashBytes(std::as_bytes(table.words()));
  header.headerHash = hashOf(header);
  return header;
}

TableKey keyOf(const FileHeader& header) {
  TableKey key;
  key.geometry = header.geometry;
  key.ior = header.ior;
  key.vertices = header.vertices;
  key.rings = header.rings;
  key.azimuths = header.azimuths;
  return key;
}

TransportTable tableAt(const FileHeader& header, const std::shared_ptr<const void>& file, uint64_t offset) {
  const TableKey key = keyOf(header);
  TableView view;
  static_cast<TableLayout&>(view) = layoutOf(key);
  view.pathScale = header.pathScale;
  view.boxMinimum = header.boxMinimum;
  view.boxExtent = header.boxExtent;
  view.words = reinterpret_cast<const uint32_t*>(static_cast<const std::byte*>(file.get()) + offset +
                                                 sizeof(FileHeader));
  return {key, view, file};
}

std::string describe(vec3 ior) {
  std::ostringstream text;
  text << ior.x;
  if (ior.y != ior.x || ior.z != ior.x) text << ", " << ior.y << ", " << ior.z;
  return text.str();
}

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& what) {
  throw InputError("table '" + file.string() + "' " + what);
}

void checkHeader(const std::filesystem::path& file, const FileHeader& header, std::size_t index) {
  if (!std::equal(std::begin(kMagic), std::end(kMagic), header.magic)) {
    reject(file, "is not a light transport table; `nephroid bake SCENE -o FILE` writes one");
  }
  if (header.version != kVersion) {
    reject(file, "has format version " + std::to_string(header.version) + ", this program reads version " +
                     std::to_string(kVersion) + "; bake it again");
  }
  if (header.headerHash != hashOf(header) || header.index != index || !isAddressable(keyOf(header))) {
    reject(file, "is damaged: a header's checksum does not fit; bake it again");
  }
}

std::vector<TransportTable> readTables(const std::filesystem::path& file, const MappedFile& mapped) {
  std::vector<TransportTable> tables;
  uint64_t offset = 0;
  uint64_t count = 1;
  while (tables.size() < count) {
    const uint64_t left = mapped.size - offset;
    FileHeader header;
    if (left < sizeof header) reject(file, "is truncated: it ends within a header; bake it again");
    std::memcpy(&header, static_cast<const std::byte*>(mapped.bytes.get()) + offset, sizeof header);
    checkHeader(file, header, tables.size());
    const uint64_t size = sizeof header + keyOf(header).words() * sizeof(uint32_t);
    if (left < size) {
      reject(file, "is truncated: " + std::to_string(mapped.size) + " of at least " +
                       std::to_string(offset + size) + " bytes; bake it again");
    }
    tables.push_back(tableAt(header, mapped.bytes, offset));
    if (hashBytes(std::as_bytes(tables.back().words())) != header.wordsHash) {
      reject(file, "is damaged: the checksum does not fit; bake it again");
    }
    count = header.tables;
    offset += size;
  }
  if (offset != mapped.size) reject(file, "is damaged: it is longer than its tables; bake it again");
  return tables;
}

[[noreturn]] void rejectForeign(const std::filesystem::path& file, std::span<const TransportTable> tables,
                                const TableKey& expected) {
  const auto sameMesh = std::find_if(tables.begin(), tables.end(), [&](const TransportTable& table) {
    return table.key().geometry == expected.geometry && table.key().vertices == expected.vertices;
  });
  if (sameMesh == tables.end()) reject(file, "was baked for another mesh; bake it again from this scene");
  const TableKey& key = sameMesh->key();
  if (key.ior != expected.ior) {
    reject(file, "was baked for the index of refraction " + describe(key.ior) + ", the material has " +
                     describe(expected.ior) + "; bake it again");
  }
  reject(file, "has " + std::to_string(key.directions()) + " directions a vertex, not " +
                   std::to_string(expected.directions()) + "; bake it again or give --directions " +
                   std::to_string(key.directions()));
}

}  // namespace

void writeTables(std::span<const TransportTable> tables, const std::filesystem::path& file) {
  AtomicFile output(file);
  std::ofstream stream(output.temporary(), std::ios::binary);
  for (std::size_t i = 0; i < tables.size(); ++i) {
    const FileHeader header = headerOf(tables[i], i, tables.size());
    stream.write(reinterpret_cast<const char*>(&header), sizeof header);
    stream.write(reinterpret_cast<const char*>(tables[i].words().data()),
                 static_cast<std::streamsize>(tables[i].sizeInBytes()));
  }
  stream.close();
  if (!stream) throw RuntimeFailure("cannot write '" + file.string() + "': " + std::strerror(errno));
  output.commit();
}

std::vector<TransportTable> openTables(const std::filesystem::path& file,
                                       std::span<const TableKey> expected) {
  const std::vector<TransportTable> tables = readTables(file, mapFile(file, "table", sizeof(FileHeader)));
  std::vector<TransportTable> found;
  for (const TableKey& key : expected) {
    const auto match = std::find_if(tables.begin(), tables.end(),
                                    [&](const TransportTable& table) { return table.key() == key; });
    if (match == tables.end()) rejectForeign(file, tables, key);
    found.push_back(*match);
  }
  return found;
}

}  // namespace nephroid
