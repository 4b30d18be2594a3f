#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "core/error.h"
#include "core/image_io.h"
#include "support/temporary_folder.h"

namespace nephroid {
namespace {

void writeText(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

Image threeChannels() {
  Image image{5, 3, {}};
  for (const char* name : {"R", "direct.R", "depth.Z"}) {
    std::vector<float>& values = image.channel(name);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<float>(i) * 1.25f + name[0];
  }
  return image;
}

TEST(Image, FindsItsChannelsByName) {
  Image image{2, 2, {}};
  image.channel("R")[3] = 7;
  EXPECT_EQ(image.channels.size(), 1u);
  EXPECT_EQ((*image.find("R"))[3], 7);
  EXPECT_EQ(image.find("G"), nullptr);
}

TEST(Exr, ReturnsWhatWasWritten) {
  const TemporaryFolder folder;
  const Image image = threeChannels();
  writeExr(folder / "a.exr", image, {{"command", "nephroid render"}, {"time", 0.5f}, {"vertices", 6400}});
  const Image back = readExr(folder / "a.exr");
  EXPECT_EQ(back.width, 5u);
  EXPECT_EQ(back.height, 3u);
  ASSERT_EQ(back.channels.size(), 3u);
  for (const ImageChannel& channel : image.channels) {
    ASSERT_NE(back.find(channel.name), nullptr) << channel.name;
    EXPECT_EQ(*back.find(channel.name), channel.values);
  }
}

TEST(Exr, KeepsValuesThatAreNotNumbers) {
  const TemporaryFolder folder;
  Image image{1, 1, {}};
  image.channel("Z")[0] = std::numeric_limits<float>::infinity();
  writeExr(folder / "a.exr", image);
  EXPECT_TRUE(std::isinf((*readExr(folder / "a.exr").find("Z"))[0]));
}

TEST(Exr, GivesTheSameBytesForTheSameImage) {
  const TemporaryFolder folder;
  writeExr(folder / "a.exr", threeChannels());
  writeExr(folder / "b.exr", threeChannels());
  EXPECT_EQ(readAll(folder / "a.exr"), readAll(folder / "b.exr"));
}

TEST(Exr, RefusesWhatIsNotOne) {
  const TemporaryFolder folder;
  EXPECT_THROW(readExr(folder / "none.exr"), InputError);
  writeText(folder / "text.exr", "this is not a picture");
  EXPECT_THROW(readExr(folder / "text.exr"), InputError);
  writeExr(folder / "a.exr", threeChannels());
  const std::string whole = readAll(folder / "a.exr");
  for (std::size_t size = 0; size < whole.size(); size += 7) {
    writeText(folder / "cut.exr", whole.substr(0, size));
    EXPECT_THROW(readExr(folder / "cut.exr"), InputError) << size << " bytes";
  }
}

TEST(Exr, LeavesNothingWhereItCannotWrite) {
  const TemporaryFolder folder;
  EXPECT_THROW(writeExr(folder / "none" / "a.exr", threeChannels()), RuntimeFailure);
  EXPECT_THROW(writeExr(folder / "a.exr", Image{}), RuntimeFailure);
  EXPECT_EQ(folder.fileCount(), 0u);
}

TEST(Png, ReturnsWhatWasWritten) {
  const TemporaryFolder folder;
  const ByteImage image{2, 1, 4, {0, 10, 255, 255, 1, 2, 3, 128}};
  writePng(folder / "a.png", image);
  EXPECT_EQ(readAll(folder / "a.png"), encodePng(image));
  const ByteImage back = readPng(folder / "a.png");
  EXPECT_EQ(back.width, 2u);
  EXPECT_EQ(back.height, 1u);
  EXPECT_EQ(back.bytes, image.bytes);
  writePng(folder / "b.png", ByteImage{1, 1, 3, {4, 5, 6}});
  EXPECT_EQ(readPng(folder / "b.png").bytes, (std::vector<uint8_t>{4, 5, 6, 255}));
}

TEST(Png, RefusesWhatIsNotOne) {
  const TemporaryFolder folder;
  EXPECT_THROW(readPng(folder / "none.png"), InputError);
  writePng(folder / "a.png", ByteImage{8, 8, 3, std::vector<uint8_t>(192, 7)});
  const std::string whole = readAll(folder / "a.png");
  writeText(folder / "cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_THROW(readPng(folder / "cut.png"), InputError);
}

TEST(Srgb, IsUndoneByItsInverse) {
  for (float value = 0; value <= 1; value += 1 / 64.f)
    EXPECT_NEAR(linearFromSrgb(srgbFromLinear(value)), value, 1e-5f);
  EXPECT_NEAR(linearFromSrgb(0.5f), 0.21404f, 1e-5f);
}

std::string pfm(const char* header, std::initializer_list<float> values) {
  std::string text = header;
  for (const float value : values) text.append(reinterpret_cast<const char*>(&value), sizeof value);
  return text;
}

TEST(Pfm, KeepsTheOrderOfRows) {
  const TemporaryFolder folder;
  writeText(folder / "a.pfm", pfm("Pf\n2 2\n-1.0\n", {1, 2, 3, 4}));
  EXPECT_EQ(*readPfm(folder / "a.pfm").find("Y"), (std::vector<float>{1, 2, 3, 4}));
  writeText(folder / "b.pfm", pfm("PF\n1 2\n-1\n", {1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(*readPfm(folder / "b.pfm").find("G"), (std::vector<float>{2, 5}));
}

TEST(Pfm, ReadsBothByteOrders) {
  const TemporaryFolder folder;
  writeText(folder / "a.pfm", std::string("Pf\n1 1\n1.0\n\x3f\x80\x00\x00", 15));
  EXPECT_EQ(*readPfm(folder / "a.pfm").find("Y"), (std::vector<float>{1}));
}

TEST(Pfm, RefusesWhatIsNotOne) {
  const TemporaryFolder folder;
  EXPECT_THROW(readPfm(folder / "none.pfm"), InputError);
  for (const char* text :
       {"", "P6\n1 1\n255\n", "Pf\n-1 4\n-1\n", "Pf\n99999999 99999999\n-1\n", "Pf\n4 4\n-1\nabc"}) {
    writeText(folder / "a.pfm", text);
    EXPECT_THROW(readPfm(folder / "a.pfm"), InputError) << text;
  }
}

// Of `width` times `height` pixels, in runs: all of them (1, 0.5, 2).
std::string radianceOfRuns(int width, int height) {
  std::string text = "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y " + std::to_string(height) + " +X " +
                     std::to_string(width) + "\n";
  for (int row = 0; row < height; ++row) {
    text += {2, 2, char(width >> 8), char(width & 255)};
    for (const int value : {64, 32, 128, 130})  // 64 / 256 x 2^(130 - 128), and so on
      for (int rest = width; rest > 0; rest -= 127) text += {char(128 + std::min(rest, 127)), char(value)};
  }
  return text;
}

TEST(Radiance, RunsAndPlainRowsAreRead) {
  const TemporaryFolder folder;
  writeText(folder / "a.hdr", radianceOfRuns(300, 3));
  ASSERT_TRUE(isRadiance(folder / "a.hdr"));
  const Image image = readRadiance(folder / "a.hdr");
  ASSERT_EQ(image.width, 300u);
  ASSERT_EQ(image.height, 3u);
  EXPECT_EQ(*image.find("R"), std::vector<float>(900, 1.0f));
  EXPECT_EQ(*image.find("G"), std::vector<float>(900, 0.5f));
  EXPECT_EQ(*image.find("B"), std::vector<float>(900, 2.0f));

  writeText(folder / "b.hdr", std::string("#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 1 +X 2\n") +
                                  std::string("\x80\x40\x20\x81\x20\x40\x80\x80", 8));
  const Image plain = readRadiance(folder / "b.hdr");
  EXPECT_EQ(*plain.find("R"), (std::vector<float>{1, 0.125f}));
  EXPECT_EQ(*plain.find("B"), (std::vector<float>{0.25f, 0.5f}));
}

TEST(Radiance, FilesThatEndTooEarlyAreRefused) {
  const TemporaryFolder folder;
  const std::string whole = radianceOfRuns(300, 3);
  for (std::size_t size = 2; size < whole.size(); ++size) {
    writeText(folder / "a.hdr", whole.substr(0, size));
    EXPECT_THROW(readRadiance(folder / "a.hdr"), InputError) << size;
  }
  writeText(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 32768 +X 32767\n");
  EXPECT_THROW(readRadiance(folder / "a.hdr"), InputError);  // and takes no memory for them
  writeText(folder / "a.hdr", "#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\nabcd");
  EXPECT_THROW(readRadiance(folder / "a.hdr"), InputError);
}

}  // namespace
}  // namespace nephroid
