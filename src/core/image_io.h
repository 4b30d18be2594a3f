// Image files. Readers throw InputError where a file is missing or wrong. Writers throw RuntimeFailure where
// it cannot be written. A file is written completely or not at all, and the same image gives the same bytes.
#pragma once

#include <filesystem>
#include <string>
#include <variant>
#include <vector>

#include "core/image.h"

namespace nephroid {

// Extra information in an EXR file: the command line, a version, a time.
struct ImageAttribute {
  std::string name;
  std::variant<std::string, float, int> value;
};

// Writes every channel as 32-bit float.
void writeExr(const std::filesystem::path& file, const Image& image,
              const std::vector<ImageAttribute>& attributes = {});
// Reads all channels, sorted by name. Half floats and integers become floats.
Image readExr(const std::filesystem::path& file);
// The attributes of the kinds that writeExr writes. Empty where the file does not exist.
std::vector<ImageAttribute> readExrAttributes(const std::filesystem::path& file);

// The bytes are taken as sRGB.
void writePng(const std::filesystem::path& file, const ByteImage& image);
// Returns the bytes that writePng would write.
std::string encodePng(const ByteImage& image);
// Reads a PNG of any kind as RGBA. No side may be longer than `largestSide` pixels.
ByteImage readPng(const std::filesystem::path& file, uint32_t largestSide = 1u << 15);

// The sRGB transfer curve (IEC 61966-2-1) and its inverse; values 0..1.
float linearFromSrgb(float encoded);
float srgbFromLinear(float linear);

// Whether a file begins as a Radiance image does.
bool isRadiance(const std::filesystem::path& file);
// Radiance image (.hdr, RGBE), rows from the top down: channels R, G, B.
Image readRadiance(const std::filesystem::path& file);

// Portable float map: channels R, G, B, or Y where it has one. The first row of the file is the first row of
// the image.
Image readPfm(const std::filesystem::path& file);

}  // namespace nephroid
