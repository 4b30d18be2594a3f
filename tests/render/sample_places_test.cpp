// The filter of pixels, and where their samples are.
#include "render/samples/sample_places.h"

#include <gtest/gtest.h>

#include <numeric>

#include "core/pixel_filter.h"

namespace nephroid {
namespace {

TEST(PixelFilter, HasTheWeightAndTheVarianceOfItsWindow) {
  constexpr int kParts = 20000;
  double before = 0, mean = 0, square = 0;
  for (int i = 0; i < kParts; ++i) {
    const double offset = kFilterRadius * (2 * (i + 0.5) / kParts - 1);
    const double below = filterWeightBelow(offset + kFilterRadius / kParts);
    EXPECT_GE(below, before);
    mean += offset * (below - before);
    square += offset * offset * (below - before);
    before = below;
  }
  EXPECT_NEAR(before, 1, 1e-12);
  EXPECT_NEAR(mean, 0, 1e-9);
  EXPECT_NEAR(square, kFilterVariance, 1e-8);
  EXPECT_EQ(filterWeightBelow(-kFilterRadius), 0);
}

TEST(PixelFilter, OffsetsAreWhereTheWeightIs) {
  for (const double part : {1e-6, 0.01, 0.3, 0.49, 0.5, 0.7, 0.999})
    EXPECT_NEAR(filterWeightBelow(filteredOffset(part)), part, 1e-12);
  EXPECT_EQ(filteredOffset(0.5), 0);
  EXPECT_EQ(filteredOffset(0.2), -filteredOffset(0.8));
  for (const float part : {0.0f, 1e-5f, 0.001f, 0.005f, 0.01f, 0.3f, 0.5f, 0.7f, 0.99f, 0.9999f})
    EXPECT_NEAR(double(quickFilteredOffset(part)), filteredOffset(double(part)), 1e-4);
}

TEST(PixelFilter, DensityIsTheSlopeOfTheWeight) {
  constexpr double kStep = 1e-5;
  for (const double offset : {-1.4, -0.5, 0.0, 0.3, 1.2})
    EXPECT_NEAR(filterDensity(offset),
                (filterWeightBelow(offset + kStep) - filterWeightBelow(offset - kStep)) / (2 * kStep), 1e-8);
}

TEST(SamplePlaces, OneIsInTheMiddle) {
  EXPECT_EQ(samplePlaces(1), std::vector<vec2>{vec2(0)});
}

// Their mean is the pixel's middle; their spread is the filter's, less what the middles of the parts leave
// out.
TEST(SamplePlaces, AreSpreadAsTheFilterIs) {
  for (const uint32_t count : {2u, 3u, 7u, 16u, 20u, 64u, 1000u, 4096u}) {
    const std::vector<vec2> places = samplePlaces(count);
    ASSERT_EQ(places.size(), count);
    for (int axis = 0; axis < 2; ++axis) {
      double sum = 0, square = 0;
      for (const vec2 place : places) {
        sum += double(place[axis]);
        square += double(place[axis]) * double(place[axis]);
        EXPECT_LT(std::abs(place[axis]), kFilterRadius);
      }
      EXPECT_NEAR(sum / count, 0, 1e-6) << count;
      EXPECT_LT(square / count, kFilterVariance) << count;
      EXPECT_NEAR(square / count, kFilterVariance, 1.05 * kFilterVariance / count) << count;
    }
  }
}

// Of a power of two: one in each of the parts of equal weight, however they are cut into rectangles.
TEST(SamplePlaces, AreOneInEachPartOfThePixel) {
  for (const uint32_t count : {4u, 16u, 64u, 256u}) {
    const std::vector<vec2> places = samplePlaces(count);
    for (uint32_t columns = 1; columns <= count; columns *= 2) {
      const uint32_t rows = count / columns;
      std::vector<int> found(count, 0);
      for (const vec2 place : places) {
        const auto column = uint32_t(filterWeightBelow(double(place.x)) * columns);
        const auto row = uint32_t(filterWeightBelow(double(place.y)) * rows);
        ++found.at(row * columns + column);
      }
      EXPECT_EQ(found, std::vector<int>(count, 1)) << count << ", " << columns << " columns";
    }
  }
}

// Also where the number is no power of two, along each axis.
TEST(SamplePlaces, AreOneInEachPartOfEachAxis) {
  for (const uint32_t count : {3u, 12u, 50u}) {
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<int> found(count, 0);
      for (const vec2 place : samplePlaces(count))
        ++found.at(uint32_t(filterWeightBelow(double(place[axis])) * count));
      EXPECT_EQ(found, std::vector<int>(count, 1));
    }
  }
}

TEST(SamplePlaces, EndWithTheNearestToTheMiddle) {
  for (const uint32_t count : {2u, 5u, 16u, 64u}) {
    const std::vector<vec2> places = samplePlaces(count);
    for (const vec2 place : places) EXPECT_LE(length(places.back()), length(place));
  }
}

}  // namespace
}  // namespace nephroid
