// Hashes of bytes, for checksums and keys.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <type_traits>

namespace nephroid {

// XXH3 with 64 bits. It serves checksums and keys of files; it does not protect against forgery.
uint64_t hashBytes(std::span<const std::byte> bytes);

// Hashes several pieces one after another. The value equals the hash of all their bytes in a row.
class Hasher {
 public:
  Hasher();
  ~Hasher();
  void add(std::span<const std::byte> bytes);
  // Adds a number, or another value without padding bytes.
  template <class T>
  void add(const T& value) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>);
    add(std::as_bytes(std::span(&value, 1)));
  }
  uint64_t value() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace nephroid
