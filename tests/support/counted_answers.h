// Answers that other programs counted, in ../shared/truth.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "core/image_io.h"
#include "formats/load.h"
#include "render/measure.h"
#include "support/shared_data.h"

namespace nephroid {

inline std::filesystem::path truthFile(const std::string& name) {
  return sharedData() / "truth" / name;
}

inline Scene truthScene(const std::string& name) {
  return loadScene(truthFile(name + ".toml"));
}

// Both tolerances are of the answer's mean; its own spread is part of the second.
inline void expectCounted(const SensorLayer& layer, const std::filesystem::path& answerFile,
                          double fluxTolerance, double rmseTolerance) {
  const Image answer = readPfm(answerFile);
  const std::vector<float>& truth = *answer.find("G");
  ASSERT_EQ(layer.size(), truth.size());
  double sum = 0, truthSum = 0, squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += double(layer[i].y);
    truthSum += double(truth[i]);
    squares += std::pow(double(layer[i].y) - double(truth[i]), 2);
  }
  EXPECT_NEAR(sum / truthSum, 1, fluxTolerance);
  EXPECT_LT(std::sqrt(squares / double(truth.size())) / (truthSum / double(truth.size())), rmseTolerance);
}

}  // namespace nephroid
