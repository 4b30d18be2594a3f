#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include "report/flip.h"

namespace nephroid {
namespace {

constexpr uint32_t kWidth = 64;
constexpr uint32_t kHeight = 48;

template <class Color>
ByteImage picture(const Color& colorAt) {
  ByteImage image{kWidth, kHeight, 3, {}};
  for (uint32_t y = 0; y < kHeight; ++y)
    for (uint32_t x = 0; x < kWidth; ++x)
      for (const int component : colorAt(int(x), int(y))) image.bytes.push_back(uint8_t(component));
  return image;
}

ByteImage plain(std::array<int, 3> color) {
  return picture([&](int, int) { return color; });
}

// Ramps and a chequered blue, moved to the left.
ByteImage pattern(int shift) {
  return picture([&](int x, int y) {
    x += shift;
    return std::array<int, 3>{4 * x % 256, (5 * y + x) % 256, (x / 8 + y / 8) % 2 == 1 ? 220 : 30};
  });
}

ByteImage noise(unsigned seed) {
  std::mt19937 random(seed);
  return picture([&](int, int) {
    return std::array<int, 3>{int(random() % 256), int(random() % 256), int(random() % 256)};
  });
}

double meanOf(const std::vector<float>& values) {
  double sum = 0;
  for (const float value : values) sum += double(value);
  return sum / double(values.size());
}

TEST(Flip, IsZeroForTheSamePicture) {
  for (const float error : ldrFlip(noise(1), noise(1))) EXPECT_EQ(error, 0);
}

TEST(Flip, StaysBetweenZeroAndOneAndDoesNotCareForTheOrder) {
  const std::vector<float> there = ldrFlip(noise(1), noise(2));
  const std::vector<float> back = ldrFlip(noise(2), noise(1));
  EXPECT_EQ(there, back);
  EXPECT_GT(*std::min_element(there.begin(), there.end()), 0);
  EXPECT_LE(*std::max_element(there.begin(), there.end()), 1);
}

TEST(Flip, IsLargestFromGreenToBlue) {
  EXPECT_NEAR(meanOf(ldrFlip(plain({0, 255, 0}), plain({0, 0, 255}))), 1, 1e-5);
}

// Of the same pictures, by the formulas of the authors' own Python version (NVlabs/flip, numpy in double
// precision). Here images are floats of 24 bits, which cube roots and powers of small differences lose some
// of.
TEST(Flip, GivesTheAuthorsValues) {
  constexpr double kRounding = 5e-5;
  EXPECT_NEAR(meanOf(ldrFlip(plain({0, 0, 0}), plain({255, 255, 255}))), 0.96737976, kRounding);
  EXPECT_NEAR(meanOf(ldrFlip(plain({100, 100, 100}), plain({110, 110, 110}))), 0.15346058, kRounding);
  EXPECT_NEAR(meanOf(ldrFlip(plain({200, 50, 30}), plain({180, 60, 30}))), 0.26156787, kRounding);

  const std::vector<float> near = ldrFlip(pattern(0), pattern(1));
  EXPECT_NEAR(meanOf(near), 0.19179334, kRounding);
  EXPECT_NEAR(near[10 * kWidth + 20], 0.07869911, kRounding);
  EXPECT_NEAR(near[40 * kWidth + 50], 0.32526898, kRounding);
  EXPECT_NEAR(near[0], 0.05666247, kRounding);
  const std::vector<float> far = ldrFlip(pattern(0), pattern(3));
  EXPECT_NEAR(meanOf(far), 0.38349898, kRounding);
  EXPECT_NEAR(*std::max_element(far.begin(), far.end()), 0.97491303, kRounding);
  const std::vector<float> coarse = ldrFlip(pattern(0), pattern(3), 30);
  EXPECT_NEAR(meanOf(coarse), 0.49460268, kRounding);
  EXPECT_NEAR(coarse[10 * kWidth + 20], 0.30228517, kRounding);
}

TEST(Flip, FindsASinglePixel) {
  const ByteImage black = plain({0, 0, 0});
  const ByteImage dot = picture([](int x, int y) {
    const int value = x == 32 && y == 24 ? 255 : 0;
    return std::array<int, 3>{value, value, value};
  });
  const std::vector<float> errors = ldrFlip(black, dot);
  EXPECT_NEAR(errors[24 * kWidth + 32], 0.86490649, 5e-5);
  EXPECT_NEAR(errors[24 * kWidth + 36], 0.01802111, 5e-5);
  EXPECT_EQ(errors[0], 0);
}

}  // namespace
}  // namespace nephroid
