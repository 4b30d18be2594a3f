// Light transport tables on disk: versioned, checksummed, and memory-mapped when read. Little-endian.
#pragma once

#include <filesystem>

#include "core/cache_folder.h"
#include "transport/table/table.h"

namespace nephroid {

// Writes the tables of a scene. The file is written beside its destination and then renamed. Throws
// RuntimeFailure where it cannot be written.
void writeTables(std::span<const TransportTable> tables, const std::filesystem::path& file);

// Returns a table for each key of `expected`, in that order. The data stays in the mapped file. Throws
// InputError, with the reason, where the file is missing, holds no tables, has another version, is truncated
// or damaged, or was baked for other meshes, indices of refraction or numbers of directions.
std::vector<TransportTable> openTables(const std::filesystem::path& file, std::span<const TableKey> expected);

// Takes the table from the cache folder, or builds it and stores it there. Errors in that folder are ignored:
// a file that cannot be used is built again, and a table that cannot be written is not stored. The least
// recently used tables are removed when the folder holds more than 2 GiB of them.
TransportTable loadOrBuildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress,
                                const std::filesystem::path& folder = cacheFolder());

}  // namespace nephroid
