#include "core/atomic_file.h"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <cstring>
#include <fstream>

#include "core/error.h"
#include "core/interrupt.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void failToWrite(const fs::path& destination, const std::string& reason) {
  throw RuntimeFailure("cannot write '" + destination.string() + "': " + reason);
}

fs::path temporaryBeside(const fs::path& destination) {
  static std::atomic<unsigned> count{0};
  fs::path temporary = destination;
  temporary.replace_filename("." + destination.filename().string() + "." + std::to_string(getpid()) + "-" +
                             std::to_string(count++) + ".part");
  return temporary;
}

void checkParent(const fs::path& destination) {
  std::error_code ignored;
  const fs::path folder = destination.has_parent_path() ? destination.parent_path() : fs::path(".");
  if (!fs::is_directory(folder, ignored))
    failToWrite(destination, "there is no folder '" + folder.string() + "'; make it first");
  if (access(folder.c_str(), W_OK) != 0) failToWrite(destination, std::strerror(errno));
}

// Without a slash at its end, and with a name of its own where it is given as "." or "..".
fs::path named(const fs::path& folder) {
  const fs::path whole = fs::absolute(folder).lexically_normal();
  return whole.has_filename() ? whole : whole.parent_path();
}

}  // namespace

void checkWritable(const fs::path& destination) {
  std::error_code ignored;
  if (!destination.has_filename() || fs::is_directory(destination, ignored))
    failToWrite(destination, "it is a folder; name a file in it");
  checkParent(destination);
}

void checkFolderWritable(const fs::path& destination) {
  std::error_code ignored;
  const fs::path folder = named(destination);
  if (fs::exists(folder, ignored) && !fs::is_directory(folder, ignored))
    failToWrite(destination, "it is a file; name a folder");
  checkParent(folder);
}

AtomicFile::AtomicFile(fs::path destination)
    : destination_(std::move(destination)), temporary_(temporaryBeside(destination_)) {
  checkWritable(destination_);
}

AtomicFile::~AtomicFile() {
  std::error_code ignored;
  if (!isCommitted_) fs::remove(temporary_, ignored);
}

void AtomicFile::commit() {
  throwIfInterrupted();
  std::error_code error;
  fs::rename(temporary_, destination_, error);
  if (error) failToWrite(destination_, error.message());
  isCommitted_ = true;
}

AtomicFolder::AtomicFolder(const fs::path& destination)
    : destination_(named(destination)), temporary_(temporaryBeside(destination_)) {
  checkFolderWritable(destination);
  std::error_code error;
  fs::create_directory(temporary_, error);
  if (error) failToWrite(destination_, error.message());
}

AtomicFolder::~AtomicFolder() {
  std::error_code ignored;
  fs::remove_all(temporary_, ignored);
}

void AtomicFolder::commit() {
  throwIfInterrupted();
  std::error_code error, ignored;
  const fs::path former = temporaryBeside(destination_);
  const bool replaces = fs::exists(destination_, ignored);
  if (replaces) fs::rename(destination_, former, error);
  if (error) failToWrite(destination_, error.message());
  fs::rename(temporary_, destination_, error);
  if (error && replaces) fs::rename(former, destination_, ignored);
  if (error) failToWrite(destination_, error.message());
  fs::remove_all(former, ignored);
}

void writeFileAtomically(const fs::path& destination, std::string_view bytes) {
  AtomicFile file(destination);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) failToWrite(destination, std::strerror(errno));
  file.commit();
}

}  // namespace nephroid
