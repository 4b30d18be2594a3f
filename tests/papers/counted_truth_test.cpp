#include "papers/counted_truth.h"

#include <gtest/gtest.h>

#include "core/error.h"
#include "formats/load.h"

namespace nephroid {
namespace {

TEST(CountedTruth, TellsTheErrorWithAndWithoutTheWorstHundredth) {
  std::vector<float> truth(200, 2.0f);
  SensorLayer lux(200, vec3(9, 2.2f, 9));
  lux[7].y = 12;
  lux[11].y = 2;
  const TruthErrors errors = errorsAgainst(truth, lux);
  EXPECT_NEAR(errors.fluxRatio, 1 + (198 * 0.2 + 10) / 400, 1e-6);
  EXPECT_NEAR(errors.relativeRmse, std::sqrt((198 * 0.04 + 100) / 200) / 2, 1e-6);
  EXPECT_NEAR(errors.withoutWorst, std::sqrt(197 * 0.04 / 198) / 2, 1e-6);
}

TEST(CountedTruth, MeansOfBlocksKeepTheWhole) {
  const std::vector<float> texels{1, 3, 10, 10, 5, 7, 20, 0};
  EXPECT_EQ(meansOfBlocks<float>(texels, 4, 2), (std::vector<float>{4, 10}));
  EXPECT_EQ(meansOfBlocks<float>(texels, 4, 1), texels);
}

TEST(CountedTruth, HasACountForEachTexelOfTheScenesThatAreShipped) {
  const std::vector<CountedTruth> truths =
      countedTruths(std::filesystem::path(NEPHROID_SOURCE_DIR) / "scenes" / "truth");
  EXPECT_FALSE(truths.empty());
  for (const CountedTruth& truth : truths) {
    const uvec2 resolution = loadScene(truth.scene).sensors.at(0).resolution;
    EXPECT_EQ(truth.lux.size(), std::size_t(resolution.x) * resolution.y) << truth.name;
  }
}

TEST(CountedTruth, IsWrongWithoutAnswers) {
  EXPECT_THROW(countedTruths("nowhere"), InputError);
}

}  // namespace
}  // namespace nephroid
