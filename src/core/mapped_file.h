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

// `kind` is what the file should be, for messages: "table". InputError where it is missing, is no file or is
// shorter than `headerBytes`; RuntimeFailure where it cannot be mapped.
MappedFile mapFile(const std::filesystem::path& file, const std::string& kind, uint64_t headerBytes);

}  // namespace nephroid
