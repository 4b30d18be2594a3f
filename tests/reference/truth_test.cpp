// Photons counted here against photons counted elsewhere, and against exact mappings.
#include <gtest/gtest.h>

#include <cmath>

#include "reference/sensor.h"
#include "support/counted_answers.h"

namespace nephroid {
namespace {

struct Case {
  const char* scene;
  const char* answer;
  Paths paths;
  double spread;  // RMS of the answer's standard error over its mean
  // A scanned mesh: what its vertices' normals bend is not defined to the last digit, so flux alone is
  // compared.
  bool isFromFile = false;
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.answer;
}

class ReferenceTruth : public testing::TestWithParam<Case> {};

struct Answer {
  const std::vector<float>& lux;
  Paths paths;
  double spread;
  bool isFromFile = false;
};

void expectWithinBothSpreads(const Scene& scene, const Answer& answer) {
  const std::vector<float>& truth = answer.lux;
  const RayScene rays(scene);
  ReferenceSettings settings;
  settings.paths = answer.paths;
  settings.photons = 1 << 16;
  ReferenceSensor sensor(scene, rays, scene.sensors.at(0), settings);
  Progress progress;
  refine(sensor, {.passes = 24}, progress);
  const Image ours = sensor.image();

  const std::vector<float>& counted = *ours.find("caustics.G");
  const std::vector<float>& variances = *ours.find("caustics.variance.G");
  ASSERT_EQ(counted.size(), truth.size());
  double mean = 0;
  for (const float value : truth) mean += double(value) / double(truth.size());
  // A counter's variance is in proportion to what it counts: that of a texel follows from the spread.
  const double variancePerLux = answer.spread * answer.spread * mean;
  // By blocks of texels, so that each has met enough photons for its spread to be known.
  constexpr uint32_t kBlock = 8;
  double difference = 0, differenceVariance = 0, squares = 0, blocks = 0;
  for (uint32_t block = 0; block < truth.size() / (kBlock * kBlock); ++block) {
    const uint32_t across = ours.width / kBlock;
    double ofBlock = 0, variance = 0;
    for (uint32_t i = 0; i < kBlock * kBlock; ++i) {
      const std::size_t texel = std::size_t(block / across * kBlock + i / kBlock) * ours.width +
                                block % across * kBlock + i % kBlock;
      ofBlock += double(counted[texel]) - double(truth[texel]);
      variance += double(variances[texel]) + variancePerLux * double(truth[texel]);
    }
    difference += ofBlock;
    differenceVariance += variance;
    if (variance <= 0) continue;
    squares += ofBlock * ofBlock / variance;
    ++blocks;
  }
  const double fluxError = difference / (mean * double(truth.size()));
  testing::Test::RecordProperty("flux_error_percent", std::to_string(100 * fluxError));
  testing::Test::RecordProperty("z_of_flux", std::to_string(difference / std::sqrt(differenceVariance)));
  testing::Test::RecordProperty("mean_square_z", std::to_string(squares / blocks));
  if (!answer.isFromFile) {
    EXPECT_LT(std::abs(difference) / std::sqrt(differenceVariance), 4)
        << "flux off by " << 100 * fluxError << " %";
    // The mean square of z is 1; more, as the answer's photons need not all weigh the same.
    EXPECT_LT(squares / blocks, 1.5);
  } else {
    // The answer lost the photons that a smooth normal sent through the mesh. Of the cow's a fiftieth more
    // land when none is lost, of the bunny's fewer.
    EXPECT_NEAR(fluxError, 0, answer.paths == Paths::all ? 0.025 : 0.01);
  }
}

TEST_P(ReferenceTruth, IsMetWithinBothSpreads) {
  const Case& wanted = GetParam();
  const std::filesystem::path answerFile = truthFile(wanted.answer);
  if (!std::filesystem::exists(answerFile)) GTEST_SKIP() << "no " << answerFile;
  const Image image = readPfm(answerFile);
  expectWithinBothSpreads(truthScene(wanted.scene),
                          {*image.find("G"), wanted.paths, wanted.spread, wanted.isFromFile});
}

constexpr Case kCases[] = {
    {"ball-point", "ball-point.transmission.pfm", Paths::transmission, 0.0079},
    {"ball-point", "ball-point.all.pfm", Paths::all, 0.0083},
    {"ball-sun-0.6", "ball-sun-0.6.transmission.pfm", Paths::transmission, 0.0095},
    {"ball-sun-0.6", "ball-sun-0.6.all.pfm", Paths::all, 0.0111},
    {"ball-sun-0.75", "ball-sun-0.75.transmission.pfm", Paths::transmission, 0.0089},
    {"ball-sun-0.75", "ball-sun-0.75.all.pfm", Paths::all, 0.0100},
    {"ball-sun-1.2", "ball-sun-1.2.transmission.pfm", Paths::transmission, 0.0098},
    {"ball-sun-1.2", "ball-sun-1.2.all.pfm", Paths::all, 0.0102},
    {"bunny-point", "bunny-point.transmission.pfm", Paths::transmission, 0.0160, true},
    {"bunny-point", "bunny-point.all.pfm", Paths::all, 0.0158, true},
    {"spot-coloured", "spot-coloured.transmission.pfm", Paths::transmission, 0.0212, true},
    {"spot-coloured", "spot-coloured.all.pfm", Paths::all, 0.0214, true},
    {"mirror-ring", "mirror-ring.all.pfm", Paths::all, 0.0325},
    {"sine-0.5", "sine-0.5.pfm", Paths::transmission, 0},
    {"sine-0.9", "sine-0.9.pfm", Paths::transmission, 0},
    {"sine-2.0", "sine-2.0.pfm", Paths::transmission, 0},
};

INSTANTIATE_TEST_SUITE_P(Scenes, ReferenceTruth, testing::ValuesIn(kCases));

class ReferenceShippedTruth : public testing::TestWithParam<CountedTruth> {};

TEST_P(ReferenceShippedTruth, IsMetWithinBothSpreads) {
  const CountedTruth& truth = GetParam();
  expectWithinBothSpreads(loadScene(truth.scene), {truth.lux, Paths::all, truth.spread});
}

INSTANTIATE_TEST_SUITE_P(Scenes, ReferenceShippedTruth, testing::ValuesIn(shippedTruths()));

}  // namespace
}  // namespace nephroid
