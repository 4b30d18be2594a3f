// Luminance to the bytes of a picture.
#include "render/tone_mapping.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "render/picture.h"
#include "scene/tone_curve.h"

namespace nephroid {
namespace {

constexpr uint kCurves[] = {kToneNeutral, kToneAgx, kToneAces, kToneLinear};

struct Shown {
  vec3 color, shown;
};

void expectShown(uint curve, std::initializer_list<Shown> all) {
  for (const Shown& one : all) {
    const vec3 shown = toneMapped(one.color, curve);
    for (int c = 0; c < 3; ++c) EXPECT_NEAR(shown[c], one.shown[c], 2e-4) << curve << ' ' << one.color.x;
  }
}

constexpr vec3 kGray(0.18f), kGreen(0.02f, 0.5f, 0.1f), kOrange(3, 1, 0.2f), kBright(40, 30, 20);

// The published functions in double precision: KhronosGroup/ToneMapping, three.js for AgX and ACES.
TEST(ToneMapping, CurvesAreThoseThatArePublished) {
  expectShown(kToneNeutral, {{kGray, vec3(0.14f)},
                             {kGreen, {0.0025f, 0.4825f, 0.0825f}},
                             {kOrange, {0.976393f, 0.467951f, 0.264574f}},
                             {kBright, {0.998540f, 0.962029f, 0.925519f}}});
  expectShown(kToneAgx, {{kGray, {0.214549f, 0.214502f, 0.214499f}},
                         {kGreen, {0.131955f, 0.415429f, 0.156746f}},
                         {kOrange, {0.874652f, 0.603448f, 0.387790f}},
                         {kBright, {0.996978f, 0.996879f, 0.996779f}}});
  expectShown(kToneAces, {{kGray, {0.213105f, 0.213105f, 0.213103f}},
                          {kGreen, {0.083274f, 0.558098f, 0.143887f}},
                          {kOrange, {0.983855f, 0.784113f, 0.440388f}},
                          {kBright, vec3(1)}});
  expectShown(kToneLinear, {{kGray, kGray}, {kOrange, {1, 1, 0.2f}}});
}

TEST(ToneMapping, BlackStaysBlackAndMoreLightIsNeverDarker) {
  for (const uint curve : kCurves) {
    EXPECT_EQ(displayed(vec3(0), {1, curve}), vec3(0)) << curve;
    float last = 0;
    for (float stop = -14; stop <= 60; stop += 0.25f) {
      const float shown = displayed(vec3(std::exp2(stop)), {1, curve}).y;
      EXPECT_GE(shown, last - 2e-4f) << curve << ' ' << stop;
      EXPECT_LE(shown, 1) << curve << ' ' << stop;
      last = shown;
    }
    EXPECT_GT(last, 0.99f) << curve;
    const float most = displayed(vec3(std::numeric_limits<float>::infinity()), {1, curve}).y;
    EXPECT_TRUE(most > 0.99f && most <= 1) << curve;
  }
}

TEST(ToneMapping, TheTransferCurveIsThatOfSrgb) {
  for (int i = 0; i <= 4096; ++i) {
    const double linear = i / 4096.0;
    const double exact = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    EXPECT_NEAR(srgbEncoded(vec3(float(linear))).x, exact, 5e-5) << linear;
  }
}

// So that a level's fraction is kept by a neighborhood, and what has none is not speckled.
TEST(ToneMapping, ThePatternKeepsFractionsAndLeavesWholeLevels) {
  constexpr uint kSide = 16;
  for (const float level : {0.25f, 0.5f, 17.1f, 100.9f, 254.6f}) {
    double sum = 0;
    for (uint row = 0; row < kSide; ++row)
      for (uint column = 0; column < kSide; ++column) {
        const float whole = levelsOf(vec3(level / 255), 1000 + column, 500 + row).x;
        EXPECT_LT(std::abs(whole - level), 1.001f);
        sum += double(whole);
      }
    EXPECT_NEAR(sum / (kSide * kSide), level, 0.02);
  }
  for (uint column = 0; column < 4096; ++column)
    for (const float level : {0.0f, 255.0f})
      EXPECT_EQ(levelsOf(vec3(level / 255), column, 77), vec3(level)) << column;
}

// White, with what is not a number and what is below black.
TEST(ToneMapping, PicturesHoldNothingButLevels) {
  Image image{2, 2, {}};
  const float values[] = {1e30f, std::numeric_limits<float>::quiet_NaN(), -3, 0};
  for (const char* name : {"R", "G", "B"}) image.channel(name).assign(values, values + 4);
  for (const Rounding rounding : {Rounding::dithered, Rounding::nearest}) {
    const ByteImage picture = pictureOf(image, {1, kToneNeutral}, "", rounding);
    for (std::size_t i = 0; i < 12; ++i) EXPECT_EQ(picture.bytes[i], i < 3 ? 255 : 0) << i;
  }
}

// Pictures that are measured: the nearest level.
TEST(ToneMapping, MeasuredPicturesAreRounded) {
  Image image{256, 1, {}};
  for (const char* name : {"R", "G", "B"})
    for (std::size_t i = 0; i < 256; ++i) image.channel(name)[i] = float(i) / 255;
  const ByteImage picture = pictureOf(image, {1, kToneLinear}, "", Rounding::nearest);
  for (std::size_t i = 0; i < 256; ++i) {
    const double linear = double(i) / 255;
    const double srgb = linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
    EXPECT_NEAR(picture.bytes[3 * i], 255 * srgb, 0.52) << i;
  }
}

// 1.2 * 2^15 nit: white at noon. Each value is a stop.
TEST(ToneMapping, ExposureValuesAreStops) {
  EXPECT_NEAR(exposureOfEv100(0), 1 / 1.2, 1e-12);
  EXPECT_NEAR(exposureOfEv100(15), 1 / (1.2 * 32768), 1e-12);
  EXPECT_NEAR(ev100OfExposure(exposureOfEv100(9.7)), 9.7, 1e-12);
}

}  // namespace
}  // namespace nephroid
