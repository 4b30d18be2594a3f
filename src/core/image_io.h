// Pictures on disk. Readers throw InputError where a file is missing or wrong, writers RuntimeFailure where
// it cannot be written; a file is there whole or not at all, and the same image gives the same bytes.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/image.h"

namespace nephroid {

// What is kept beside the pixels of an EXR: the command line, a version, a time.
struct ImageAttribute {
  std::string name;
  std::variant<std::string, float, int> value;
};

// Every channel as 32-bit float.
void writeExr(const std::filesystem::path& file, const Image& image,
              const std::vector<ImageAttribute>& attributes = {});
// All channels, sorted by name; half floats and integers become floats.
Image readExr(const std::filesystem::path& file);
// Those of the kinds that writeExr writes; none where there is no such file.
std::vector<ImageAttribute> readExrAttributes(const std::filesystem::path& file);

// The bytes are taken as sRGB.
void writePng(const std::filesystem::path& file, const ByteImage& image);
// The bytes of such a file.
std::string encodePng(const ByteImage& image);
// As RGBA, whatever the file holds. No side may be longer than `largestSide` pixels.
ByteImage readPng(const std::filesystem::path& file, uint32_t largestSide = 1u << 15);

// 0 to 1, undoing the sRGB transfer curve (IEC 61966-2-1).
float linearFromSrgb(float encoded);
float srgbFromLinear(float linear);

// Portable float map: channels R, G, B, or Y where it has one. The first row of the file is the first row of
// the image.
Image readPfm(const std::filesystem::path& file);

}  // namespace nephroid
