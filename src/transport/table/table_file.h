// Light transport tables on disk: versioned, checksummed, and memory-mapped when read. Little-endian.
#pragma once

#include <filesystem>

#include "core/cache_folder.h"
#include "transport/table/table.h"

namespace nephroid {

// The tables of a scene, one after another. Written beside its place and renamed. RuntimeFailure when that
// cannot be done.
void writeTables(std::span<const TransportTable> tables, const std::filesystem::path& file);

// A table for each of `expected`, in that order, served straight from the mapped file. InputError, saying
// which, when the file is missing, holds no tables, is of another version, truncated or damaged, or was baked
// for other meshes, indices of refraction or numbers of directions.
std::vector<TransportTable> openTables(const std::filesystem::path& file, std::span<const TableKey> expected);

// The table from the cache folder, or built and left there. Nothing in that folder is an error: what cannot
// be used is built anew, and what cannot be written is not. The least recently used tables go when the folder
// holds more than 2 GiB of them.
TransportTable loadOrBuildTable(const Mesh& mesh, vec3 ior, const TableSettings& settings, Progress& progress,
                                const std::filesystem::path& folder = cacheFolder());

}  // namespace nephroid
