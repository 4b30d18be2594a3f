// A file, or a folder, that is there whole or not at all.
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

// A folder of files. Write into `temporary()`, which lies beside the destination, then commit(). Without a
// commit it is removed and what stood at the destination stays.
class AtomicFolder {
 public:
  // Throws RuntimeFailure where no folder can be made there.
  explicit AtomicFolder(const std::filesystem::path& destination);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // In place of the folder that stood at the destination, which is removed with all that is in it. Throws
  // RuntimeFailure where it cannot be put in place, Interrupted after Ctrl-C.
  void commit();

 private:
  std::filesystem::path destination_;
  std::filesystem::path temporary_;
};

// Throws RuntimeFailure, as writing would: there is no folder to put it into, or no right to.
void checkFolderWritable(const std::filesystem::path& destination);

void writeFileAtomically(const std::filesystem::path& destination, std::string_view bytes);

}  // namespace nephroid
