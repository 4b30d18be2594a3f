#include "report/metrics.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "report/false_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kSide = 128;

// Every channel of the layer by a function of the pixel.
template <class Value>
void fill(Image& image, const std::string& layer, const Value& value) {
  image.width = image.height = kSide;
  for (const char* channel : {"R", "G", "B"}) {
    std::vector<float>& values = image.channel(layer + channel);
    for (std::size_t i = 0; i < values.size(); ++i) values[i] = float(value(i));
  }
}

Image constantImage(double value) {
  Image image;
  fill(image, "", [&](std::size_t) { return value; });
  return image;
}

TEST(Metrics, AreZeroForTheSameImage) {
  const LayerErrors errors = layerErrors(constantImage(3), constantImage(3), "");
  EXPECT_EQ(errors.referenceMean, 3);
  EXPECT_EQ(errors.fluxRatio, 1);
  EXPECT_EQ(errors.relativeRmse, 0);
  EXPECT_EQ(errors.mape, 0);
  EXPECT_EQ(errors.countedFraction, 1);
  EXPECT_FALSE(errors.noiseFloor);
  EXPECT_FALSE(errors.zScoreRms);
}

TEST(Metrics, TellWhatIsMissing) {
  const LayerErrors errors = layerErrors(constantImage(4), constantImage(3), "");
  EXPECT_DOUBLE_EQ(errors.fluxRatio, 0.75);
  EXPECT_DOUBLE_EQ(errors.relativeRmse, 0.25);
  EXPECT_DOUBLE_EQ(errors.mape, 0.25);
  EXPECT_FLOAT_EQ(relativeErrors(constantImage(4), constantImage(3), "")[7], -0.25f);
  EXPECT_FLOAT_EQ(absoluteErrors(constantImage(4), constantImage(3), "")[7], 1);
}

TEST(Metrics, AreOfTheirLayer) {
  Image reference = constantImage(4), image = constantImage(4);
  fill(reference, "caustics.", [](std::size_t i) { return i == 0 ? 2.0 : 0.0; });
  fill(image, "caustics.", [](std::size_t) { return 0.0; });
  EXPECT_EQ(layerErrors(reference, image, "").relativeRmse, 0);
  EXPECT_EQ(layerErrors(reference, image, "caustics.").fluxRatio, 0);
  // The whole flux in one of n pixels: sqrt(n).
  EXPECT_NEAR(layerErrors(reference, image, "caustics.").relativeRmse, kSide, 1e-9);
  EXPECT_TRUE(hasLayer(image, "caustics."));
  EXPECT_FALSE(hasLayer(image, "direct."));
}

TEST(Metrics, HaveNoRatioToNothing) {
  const LayerErrors errors = layerErrors(constantImage(0), constantImage(1), "");
  EXPECT_TRUE(std::isnan(errors.fluxRatio));
  EXPECT_TRUE(std::isnan(errors.relativeRmse));
  EXPECT_TRUE(std::isnan(errors.mape));
  EXPECT_EQ(errors.countedFraction, 0);
  EXPECT_TRUE(std::isnan(relativeErrors(constantImage(0), constantImage(1), "")[0]));
}

// A reference that is the truth and noise of known variance, and an image that is the truth: all the error
// there is, is the reference's. The mean square of n unit deviates about m has the standard error sqrt((2 + 4
// m^2) / n), its root that over twice the root.
TEST(Metrics, TellTheReferencesNoiseFromError) {
  constexpr double kTruth = 10, kDeviation = 0.5;
  const double values = 3.0 * kSide * kSide;
  const double standardError = std::sqrt(2 / values) / 2;
  std::mt19937 random(5);
  std::normal_distribution<double> noise(0, kDeviation);
  Image reference;
  fill(reference, "", [&](std::size_t) { return kTruth + noise(random); });
  fill(reference, "variance.", [&](std::size_t) { return kDeviation * kDeviation; });
  const LayerErrors right = layerErrors(reference, constantImage(kTruth), "");
  EXPECT_NEAR(*right.noiseFloor, kDeviation / kTruth, 1e-3);
  EXPECT_NEAR(right.relativeRmse / *right.noiseFloor, 1, 4 * standardError + 1e-3);
  EXPECT_NEAR(*right.zScoreRms, 1, 4 * standardError);
  const LayerErrors wrong = layerErrors(reference, constantImage(kTruth + 3 * kDeviation), "");
  EXPECT_NEAR(*wrong.zScoreRms, std::sqrt(10.0), 4 * std::sqrt(38 / values) / (2 * std::sqrt(10.0)));
}

TEST(Metrics, LeaveOutOfPercentagesWhatIsNotToldFromNothing) {
  Image reference, image = constantImage(1);
  fill(reference, "", [](std::size_t i) { return i % 4 == 0 ? 0.01 : 2.0; });
  fill(reference, "variance.", [](std::size_t) { return 0.04 * 0.04; });
  const LayerErrors errors = layerErrors(reference, image, "");
  EXPECT_DOUBLE_EQ(errors.countedFraction, 0.75);
  EXPECT_DOUBLE_EQ(errors.mape, 0.5);
  EXPECT_TRUE(std::isnan(relativeErrors(reference, image, "")[0]));
}

TEST(Metrics, FindQuantiles) {
  EXPECT_EQ(quantile({3, 1, 2, NAN, 5, 4}, 0.5), 3);
  EXPECT_EQ(quantile({3, 1, 2}, 1), 3);
  EXPECT_EQ(quantile({}, 0.5), 0);
}

double lightnessOf(const SrgbColor& color) {
  double luminance = 0;
  for (const auto& [weight, c] : {std::pair(0.2126, 0), std::pair(0.7152, 1), std::pair(0.0722, 2)})
    luminance += weight * std::pow(color[std::size_t(c)] / 255.0, 2.2);
  return luminance;
}

TEST(FalseColor, IsBrighterWhereThereIsMore) {
  double last = -1;
  for (int i = 0; i <= 32; ++i) {
    const double lightness = lightnessOf(magnitudeColor(float(i) / 32));
    EXPECT_GT(lightness, last) << i;
    last = lightness;
  }
  // The ends of matplotlib's table are (0, 0, 4) and (252, 253, 191); the polynomial is within 2 % of it.
  const SrgbColor low = magnitudeColor(0), high = magnitudeColor(1);
  EXPECT_LE(std::max({low[0], low[1], low[2]}), 4);
  EXPECT_NEAR(high[0], 252, 5);
  EXPECT_NEAR(high[1], 253, 5);
  EXPECT_NEAR(high[2], 191, 5);
  EXPECT_EQ(magnitudeColor(7), high);
  EXPECT_EQ(magnitudeColor(NAN), low);
}

TEST(FalseColor, HasASignAndAMiddle) {
  EXPECT_EQ(signedColor(0), (SrgbColor{0xf7, 0xf7, 0xf7}));
  EXPECT_EQ(signedColor(-9), (SrgbColor{0x05, 0x30, 0x61}));
  EXPECT_EQ(signedColor(9), (SrgbColor{0x67, 0x00, 0x1f}));
  EXPECT_GT(signedColor(0.5f)[0], signedColor(0.5f)[2]);
  EXPECT_LT(signedColor(-0.5f)[0], signedColor(-0.5f)[2]);
  EXPECT_EQ(signedColor(NAN), kNoValueColor);
}

TEST(FalseColor, MapsValuesOfItsScale) {
  const std::vector<float> values{0, 0.5f, 1, NAN};
  const ByteImage map = signedMap(values, 2, 2, 0.5);
  ASSERT_EQ(map.bytes.size(), 12u);
  EXPECT_EQ(map.bytes[0], 0xf7);
  EXPECT_EQ(map.bytes[3], 0x67);
  EXPECT_EQ(map.bytes[9], kNoValueColor[0]);
  EXPECT_EQ(endOfScale(0.013), 0.02);
  EXPECT_EQ(endOfScale(3), 5);
  EXPECT_EQ(endOfScale(5), 5);
  EXPECT_EQ(endOfScale(7), 10);
  EXPECT_EQ(endOfScale(0), 1);
}

}  // namespace
}  // namespace nephroid
