#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>

#include "core/atomic_file.h"
#include "core/error.h"
#include "core/image_io.h"

namespace nephroid {
namespace {

// libpng's own memory, freed whatever is thrown.
struct PngImage : png_image {
  PngImage() : png_image{} { version = PNG_IMAGE_VERSION; }
  ~PngImage() { png_image_free(this); }
  PngImage(const PngImage&) = delete;
  PngImage& operator=(const PngImage&) = delete;
};

}  // namespace

std::string encodePng(const ByteImage& image) {
  PngImage png;
  png.width = image.width;
  png.height = image.height;
  png.format = image.components == 4 ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  std::string encoded(PNG_IMAGE_PNG_SIZE_MAX(png), '\0');
  png_alloc_size_t size = encoded.size();
  if (!png_image_write_to_memory(&png, encoded.data(), &size, 0, image.bytes.data(), 0, nullptr))
    throw RuntimeFailure(std::string("cannot make a PNG: ") + png.message);
  encoded.resize(size);
  return encoded;
}

void writePng(const std::filesystem::path& path, const ByteImage& image) {
  writeFileAtomically(path, encodePng(image));
}

ByteImage readPng(const std::filesystem::path& path, uint32_t largestSide) {
  const auto fail = [&](const std::string& reason) {
    throw InputError("cannot read '" + path.string() + "' as PNG: " + reason);
  };
  PngImage png;
  if (!png_image_begin_read_from_file(&png, path.c_str())) fail(png.message);
  if (std::max(png.width, png.height) > largestSide)
    fail("no side may be longer than " + std::to_string(largestSide) + " pixels");
  png.format = PNG_FORMAT_RGBA;
  ByteImage image{png.width, png.height, 4, std::vector<uint8_t>(PNG_IMAGE_SIZE(png))};
  if (!png_image_finish_read(&png, nullptr, image.bytes.data(), 0, nullptr)) fail(png.message);
  return image;
}

float linearFromSrgb(float encoded) {
  return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float srgbFromLinear(float linear) {
  return linear <= 0.0031308f ? linear * 12.92f : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

}  // namespace nephroid
