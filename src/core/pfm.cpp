#include <bit>
#include <fstream>
#include <string>

#include "core/error.h"
#include "core/image_io.h"

namespace nephroid {
namespace {

constexpr int64_t kMaximumSide = 1 << 15;

void swapBytes(std::vector<float>& values) {
  for (float& value : values) {
    const auto bits = std::bit_cast<uint32_t>(value);
    value = std::bit_cast<float>(__builtin_bswap32(bits));
  }
}

}  // namespace

Image readPfm(const std::filesystem::path& path) {
  const auto fail = [&](const std::string& reason) {
    throw InputError("cannot read '" + path.string() + "' as a portable float map: " + reason);
  };
  std::ifstream file(path, std::ios::binary);
  if (!file) fail("no such file");
  std::string kind;
  int64_t width = 0, height = 0;
  double scale = 0;
  file >> kind >> width >> height >> scale;
  if (!file || (kind != "PF" && kind != "Pf") || scale == 0)
    fail("it begins with 'PF' or 'Pf', its width, its height and a scale");
  if (width < 1 || height < 1 || width > kMaximumSide || height > kMaximumSide)
    fail("a side is 1 to 32768 pixels, not " + std::to_string(width) + " x " + std::to_string(height));
  file.get();

  const std::size_t components = kind == "PF" ? 3 : 1;
  Image image{static_cast<uint32_t>(width), static_cast<uint32_t>(height), {}};
  std::vector<float> values(image.pixelCount() * components);
  file.read(reinterpret_cast<char*>(values.data()),
            static_cast<std::streamsize>(values.size() * sizeof(float)));
  if (!file) fail("it ends too early");
  const bool isLittleEndian = scale < 0;
  if (isLittleEndian != (std::endian::native == std::endian::little)) swapBytes(values);
  for (std::size_t c = 0; c < components; ++c) {
    std::vector<float>& channel = image.channel(components == 1 ? "Y" : std::string(1, "RGB"[c]));
    for (std::size_t i = 0; i < channel.size(); ++i) channel[i] = values[i * components + c];
  }
  return image;
}

}  // namespace nephroid
