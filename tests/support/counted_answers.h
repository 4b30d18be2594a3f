// Answers that other programs counted, in ../shared/truth and in scenes/truth.
#pragma once

#include <gtest/gtest.h>

#include <string>

#include "core/image_io.h"
#include "formats/load.h"
#include "papers/counted_truth.h"
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
  const TruthErrors errors = errorsAgainst(truth, layer);
  EXPECT_NEAR(errors.fluxRatio, 1, fluxTolerance);
  EXPECT_LT(errors.relativeRmse, rmseTolerance);
}

// The answers that are part of the repository.
inline std::vector<CountedTruth> shippedTruths() {
  return countedTruths(std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes" / "truth");
}

inline void PrintTo(const CountedTruth& truth, std::ostream* out) {
  *out << truth.name;
}

}  // namespace nephroid
