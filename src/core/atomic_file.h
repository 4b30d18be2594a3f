// A file that is there whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nephroid {

// Write to `temporary()`, which lies beside the destination, then commit(). Without a commit, by an exception
// or Ctrl-C, it is removed and what stood at the destination stays.
class AtomicFile {
 public:
  // Throws RuntimeFailure where the folder cannot be written or the destination is a folder.
  explicit AtomicFile(std::filesystem::path destination);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // Throws RuntimeFailure where it cannot be put in place, Interrupted after Ctrl-C.
  void commit();

 private:
  std::filesystem::path destination_;
  std::filesystem::path temporary_;
  bool isCommitted_ = false;
};

// Throws RuntimeFailure, as writing would, before the work whose result is to be written.
void checkWritable(const std::filesystem::path& destination);

void writeFileAtomically(const std::filesystem::path& destination, std::string_view bytes);

}  // namespace nephroid
