// A sensor's texels in square blocks, held against the reference's.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "render/measure.h"
#include "support/reference_scenes.h"

namespace nephroid {

constexpr uint32_t kBlocks = 6, kTexelsOfBlock = 8;  // along a side
// Beams are flat over triangles, and direct light is looked at 32 times along a block: of a block's light,
// and of the mean where light comes from blocks beside it.
constexpr double kModelError = 0.01;

inline std::vector<double> blocksOf(const SensorLayer& layer, int channel) {
  std::vector<double> blocks(kBlocks * kBlocks, 0.0);
  const uint32_t side = kBlocks * kTexelsOfBlock;
  for (uint32_t i = 0; i < side * side; ++i)
    blocks[i / side / kTexelsOfBlock * kBlocks + i % side / kTexelsOfBlock] +=
        double(layer[i][channel]) / (kTexelsOfBlock * kTexelsOfBlock);
  return blocks;
}

inline void expectMean(const std::vector<double>& blocks, const std::vector<SampleMean>& reference,
                       const char* what, double modelError = kModelError) {
  double mean = 0, chiSquare = 0;
  for (const SampleMean& block : reference) mean += block.mean() / double(reference.size());
  if (mean == 0) {
    EXPECT_EQ(*std::ranges::max_element(blocks), 0) << what;
    return;
  }
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const double error =
        std::hypot(reference[i].standardError(), modelError * mean, modelError * reference[i].mean());
    chiSquare += std::pow((blocks[i] - reference[i].mean()) / error, 2);
  }
  EXPECT_LE(chiSquare, chiSquareLimit(double(blocks.size()))) << what;
}

}  // namespace nephroid
