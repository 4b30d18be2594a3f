// Whether what was drawn at random is distributed as it should be.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace nephroid {

// What a chi-square of so many degrees of freedom is above once in ten thousand times (Wilson and Hilferty
// 1931).
inline double chiSquareLimit(double degrees) {
  constexpr double kNormalQuantile = 3.719;  // 1e-4 of a normal distribution lies above
  const double spread = 2 / (9 * degrees);
  return degrees * std::pow(1 - spread + kNormalQuantile * std::sqrt(spread), 3);
}

// The mean of samples and how far it may be off.
class SampleMean {
 public:
  void add(double value) {
    ++count;
    const double step = value - average;
    average += step / count;
    squares += std::max(0.0, step * (value - average));
  }
  double mean() const { return average; }
  double standardError() const { return std::sqrt(squares / (count * (count - 1))); }

 private:
  double count = 0, average = 0, squares = 0;
};

// Samples, each with a weight, by the bin they fall into.
class WeightedHistogram {
 public:
  explicit WeightedHistogram(std::size_t bins) : sums(bins, 0.0), squares(bins, 0.0) {}

  void add(std::size_t bin, double weight = 1) {
    ++samples;
    sums.at(bin) += weight;
    squares.at(bin) += weight * weight;
  }

  // `expected`: the mean of the weight that a sample adds to each bin. Enough samples have to fall into each
  // that its spread is known from them.
  void expectMeans(const std::vector<double>& expected) const {
    ASSERT_EQ(expected.size(), sums.size());
    double chiSquare = 0, degrees = 0;
    for (std::size_t bin = 0; bin < sums.size(); ++bin) {
      const double mean = sums[bin] / samples;
      const double variance = (squares[bin] / samples - mean * mean) / samples;
      const double difference = mean - expected[bin];
      const double rounding = 1e-6 * expected[bin];  // of weights in single precision
      if (std::abs(difference) <= rounding) continue;
      ASSERT_GT(variance, 0) << "bin " << bin << ": " << mean << ", not " << expected[bin];
      chiSquare += difference * difference / variance;
      ++degrees;
    }
    EXPECT_LE(chiSquare, degrees > 0 ? chiSquareLimit(degrees) : 0)
        << "of " << degrees << " degrees of freedom";
  }
  void expectUniform() const { expectMeans(std::vector<double>(sums.size(), 1.0 / double(sums.size()))); }

 private:
  double samples = 0;
  std::vector<double> sums, squares;
};

// The bin, of `count` equal ones, of a number that should be in [0, 1] but for rounding.
inline std::size_t binOf(double fraction, std::size_t count) {
  EXPECT_GT(fraction, -1e-4);
  EXPECT_LT(fraction, 1 + 1e-4);
  const double place = fraction * double(count);
  return place > 0 ? std::min(static_cast<std::size_t>(place), count - 1) : 0;
}

}  // namespace nephroid
