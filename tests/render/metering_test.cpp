// Pictures whose exposure is known in closed form.
#include "render/metering.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace nephroid {
namespace {

constexpr double kKey = 0.18;

std::vector<float> parts(std::initializer_list<std::pair<std::size_t, float>> all) {
  std::vector<float> luminances;
  for (const auto& [count, luminance] : all) luminances.insert(luminances.end(), count, luminance);
  return luminances;
}

void expectExposure(const std::vector<float>& luminances, double exposure) {
  EXPECT_NEAR(meteredExposure(luminances), exposure, 2e-6 * exposure);
}

TEST(Metering, BringsAnEvenPictureToItsKey) {
  for (const float nit : {1e-4f, 0.3f, 5.0f, 30000.0f})
    expectExposure(parts({{100, nit}}), kKey / double(nit));
}

// The log-average, and the key as it leans to one end.
TEST(Metering, FollowsTheLogAverage) {
  expectExposure(parts({{500, 2}, {500, 8}}), kKey / 4);
  expectExposure(parts({{900, 1}, {100, 16}}), kKey * std::exp2(-0.8) / std::exp2(0.4));
  // Nine tenths bright: the key is the most that it may be.
  expectExposure(parts({{100, 1}, {900, 16}}), 0.22 / std::exp2(3.6));
}

TEST(Metering, BlackAndTheFewBrightestDoNotCount) {
  const double alone = kKey / 4;
  expectExposure(parts({{500, 2}, {500, 8}, {9000, 0}}), alone);
  expectExposure(parts({{500, 2}, {500, 8}, {9000, 1e-6f}}), alone);  // seen by nobody beside the others
  const double withSun = double(meteredExposure(parts({{500, 2}, {495, 8}, {5, 1.6e9f}})));
  EXPECT_NEAR(withSun / alone, 1, 0.01);
  const float infinite = std::numeric_limits<float>::infinity();
  const float none = std::numeric_limits<float>::quiet_NaN();
  expectExposure(parts({{500, 2}, {500, 8}, {10, infinite}, {10, none}, {10, -1}}), alone);
  expectExposure(parts({{100, 0}}), 1);
  expectExposure({}, 1);
}

// From a candle's light to the sun's the picture is the same.
TEST(Metering, FollowsTheLightAndNotTheOrder) {
  std::vector<float> luminances;
  for (int i = 0; i < 4000; ++i) luminances.push_back(0.02f + float(i * 7919 % 1000) / 100);
  const double before = double(meteredExposure(luminances));
  std::vector<float> brighter = luminances;
  for (float& luminance : brighter) luminance *= 1e5f;
  EXPECT_NEAR(double(meteredExposure(brighter)) * 1e5 / before, 1, 1e-5);
  std::ranges::sort(luminances);
  EXPECT_NEAR(double(meteredExposure(luminances)) / before, 1, 1e-6);
}

TEST(Metering, ACameraThatGivesAnExposureKeepsIt) {
  Image image{2, 1, {}};
  for (const char* name : {"R", "G", "B"}) image.channel(name).assign({4, 4});
  Camera camera;
  EXPECT_NEAR(toneMappingOf(camera, image).exposure, kKey / 4, 1e-6);
  camera.exposure = 3.0f;
  camera.tone = ToneCurve::agx;
  EXPECT_EQ(toneMappingOf(camera, image).exposure, 3);
  EXPECT_EQ(toneMappingOf(camera, image).curve, kToneAgx);
}

}  // namespace
}  // namespace nephroid
