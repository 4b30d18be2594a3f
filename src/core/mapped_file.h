// Files mapped into memory for reading.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

namespace nephroid {

// A whole file's bytes, mapped into memory and read-only; the mapping lasts as long as `bytes`.
struct MappedFile {
  std::shared_ptr<const void> bytes;
  uint64_t size = 0;
};

// Maps a file. `kind` names what the file should be, for messages: "table". Throws InputError where the file
// is missing, is not a regular file or is shorter than `headerBytes`, and RuntimeFailure where it cannot be
// mapped.
MappedFile mapFile(const std::filesystem::path& file, const std::string& kind, uint64_t headerBytes);

}  // namespace nephroid
