// The cache: files that can be made again, kept between runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace nephroid {

// $XDG_CACHE_HOME/nephroid or ~/.cache/nephroid; empty when neither is known.
std::filesystem::path cacheFolder();

// Marks the file as used now.
void touchCached(const std::filesystem::path& file);

// Removes the least recently used files of the extension until the rest fit in `bytes`. Another process may
// be doing the same.
void trimCache(const std::filesystem::path& folder, const std::string& extension, uint64_t bytes);

}  // namespace nephroid
