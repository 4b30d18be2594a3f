// Files and folders that are written completely or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace nephroid {

// Write to `temporary()`, a file beside the destination, then call commit(). Without a commit (after an
// exception or Ctrl-C) the temporary file is removed and the old file at the destination stays.
class AtomicFile {
 public:
  // Throws RuntimeFailure where the folder cannot be written or the destination is a folder.
  explicit AtomicFile(std::filesystem::path destination);
  ~AtomicFile();
  AtomicFile(const AtomicFile&) = delete;
  AtomicFile& operator=(const AtomicFile&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // Moves the file to its destination. Throws RuntimeFailure where that fails, and Interrupted after Ctrl-C.
  void commit();

 private:
  std::filesystem::path destination_;
  std::filesystem::path temporary_;
  bool isCommitted_ = false;
};

// Throws RuntimeFailure where the file could not be written. Call it before long work whose result goes
// there.
void checkWritable(const std::filesystem::path& destination);

// A folder of files. Write into `temporary()`, a folder beside the destination, then call commit(). Without a
// commit the temporary folder is removed and the old folder at the destination stays.
class AtomicFolder {
 public:
  // Throws RuntimeFailure where no folder can be made there.
  explicit AtomicFolder(const std::filesystem::path& destination);
  ~AtomicFolder();
  AtomicFolder(const AtomicFolder&) = delete;
  AtomicFolder& operator=(const AtomicFolder&) = delete;

  const std::filesystem::path& temporary() const { return temporary_; }
  // Moves the folder to its destination. An old folder there is removed with everything in it. Throws
  // RuntimeFailure where that fails, and Interrupted after Ctrl-C.
  void commit();

 private:
  std::filesystem::path destination_;
  std::filesystem::path temporary_;
};

// Throws RuntimeFailure where the folder could not be written: its parent does not exist, or the user has no
// right to write there.
void checkFolderWritable(const std::filesystem::path& destination);

void writeFileAtomically(const std::filesystem::path& destination, std::string_view bytes);

}  // namespace nephroid
