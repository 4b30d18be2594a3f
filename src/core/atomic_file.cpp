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

}  // namespace

void checkWritable(const fs::path& destination) {
  std::error_code ignored;
  const fs::path folder = destination.has_parent_path() ? destination.parent_path() : fs::path(".");
  if (!destination.has_filename() || fs::is_directory(destination, ignored))
    failToWrite(destination, "it is a folder; name a file in it");
  if (!fs::is_directory(folder, ignored))
    failToWrite(destination, "there is no folder '" + folder.string() + "'; make it first");
  if (access(folder.c_str(), W_OK) != 0) failToWrite(destination, std::strerror(errno));
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

void writeFileAtomically(const fs::path& destination, std::string_view bytes) {
  AtomicFile file(destination);
  std::ofstream stream(file.temporary(), std::ios::binary);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) failToWrite(destination, std::strerror(errno));
  file.commit();
}

}  // namespace nephroid
