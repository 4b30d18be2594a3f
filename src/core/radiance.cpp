#include <algorithm>
#include <cstring>
#include <memory>
#include <span>

#include "core/error.h"
#include "core/image_io.h"
#include "core/mapped_file.h"

#define STB_IMAGE_IMPLEMENTATION
#define STB_IMAGE_STATIC
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS (1 << 15)
#include <stb_image.h>

namespace nephroid {
namespace {

// What the decoder gets after the end of a file, where it would ask forever for more: in the header lines
// without text, in the rows runs of a single value.
constexpr char kLine = '\n', kRunOfOne = char(129);

struct Source {
  std::span<const std::byte> rest;
  char padding;
  bool hasEnded = false;  // too early

  static int read(void* source, char* data, int size) {
    auto& self = *static_cast<Source*>(source);
    if (self.rest.empty()) {
      self.hasEnded = true;
      std::fill_n(data, size, self.padding);
      return size;
    }
    const std::size_t count = std::min(self.rest.size(), std::size_t(size));
    std::memcpy(data, self.rest.data(), count);
    self.rest = self.rest.subspan(count);
    return int(count);
  }
  static void skip(void* source, int size) {
    auto& self = *static_cast<Source*>(source);
    self.rest = self.rest.subspan(std::min(self.rest.size(), std::size_t(size)));
  }
  static int isAtEnd(void* source) { return static_cast<Source*>(source)->rest.empty() ? 1 : 0; }
};

// How short a file of this size can be: short rows are not compressed; in others two bytes are 127 pixels of
// a channel.
uint64_t leastBytes(int width, int height) {
  if (width < 8) return uint64_t(height) * 4 * uint64_t(width);
  return uint64_t(height) * (4 + 4 * 2 * ((uint64_t(width) + 126) / 127));
}

}  // namespace

bool isRadiance(const std::filesystem::path& path) {
  const MappedFile file = mapFile(path, "image", 2);
  return std::memcmp(file.bytes.get(), "#?", 2) == 0;
}

Image readRadiance(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& reason) {
    throw InputError("cannot read '" + path.string() + "' as a Radiance image: " + reason);
  };
  const MappedFile file = mapFile(path, "Radiance image", 2);
  const std::span bytes(static_cast<const std::byte*>(file.bytes.get()), file.size);
  const stbi_io_callbacks callbacks{Source::read, Source::skip, Source::isAtEnd};
  int width = 0, height = 0, channels = 0;
  Source header{bytes, kLine};
  if (!stbi_info_from_callbacks(&callbacks, &header, &width, &height, &channels) || header.hasEnded)
    fail("its header should have #?RADIANCE, FORMAT=32-bit_rle_rgbe, and a size as -Y 512 +X 1024");
  if (width < 1 || height < 1 || width > STBI_MAX_DIMENSIONS || height > STBI_MAX_DIMENSIONS)
    fail("a side is 1 to 32768 pixels, not " + std::to_string(width) + " x " + std::to_string(height));
  if (file.size < leastBytes(width, height)) fail("it ends too early");
  Source source{bytes, kRunOfOne};
  const std::unique_ptr<float, decltype(&stbi_image_free)> values(
      stbi_loadf_from_callbacks(&callbacks, &source, &width, &height, &channels, 3), stbi_image_free);
  if (!values) fail(stbi_failure_reason());
  if (source.hasEnded) fail("it ends too early");
  Image image{uint32_t(width), uint32_t(height), {}};
  for (std::size_t c = 0; c < 3; ++c) {
    std::vector<float>& channel = image.channel(std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < channel.size(); ++i) channel[i] = values.get()[3 * i + c];
  }
  return image;
}

}  // namespace nephroid
