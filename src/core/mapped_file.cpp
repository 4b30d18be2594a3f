#include "core/mapped_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "core/error.h"

namespace nephroid {
namespace {

[[noreturn]] void reject(const std::filesystem::path& file, const std::string& kind,
                         const std::string& what) {
  throw InputError(kind + " '" + file.string() + "' " + what);
}

class Descriptor {
 public:
  // Does not wait where the file is a pipe that nobody writes to.
  Descriptor(const std::filesystem::path& file, const std::string& kind)
      : number(open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)) {
    if (number < 0) reject(file, kind, std::string("cannot be read: ") + std::strerror(errno));
  }
  ~Descriptor() { close(number); }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  const int number;
};

}  // namespace

MappedFile mapFile(const std::filesystem::path& file, const std::string& kind, uint64_t headerBytes) {
  const Descriptor descriptor(file, kind);
  struct stat status {};
  if (fstat(descriptor.number, &status) != 0)
    reject(file, kind, std::string("cannot be read: ") + std::strerror(errno));
  if (!S_ISREG(status.st_mode)) reject(file, kind, "is not a file; `nephroid bake SCENE -o FILE` writes one");
  const auto size = static_cast<std::size_t>(status.st_size);
  if (size < headerBytes) reject(file, kind, "is truncated: it is shorter than its header; bake it again");
  void* address = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, descriptor.number, 0);
  if (address == MAP_FAILED) {
    throw RuntimeFailure(kind + " '" + file.string() +
                         "' cannot be mapped into memory: " + std::strerror(errno));
  }
  return {std::shared_ptr<const void>(
              address, [size](const void* mapped) { munmap(const_cast<void*>(mapped), size); }),
          size};
}

}  // namespace nephroid
