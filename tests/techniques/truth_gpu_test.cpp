// Techniques against independently counted photons, read as a camera would see a receiver in the sensor's
// place.
#include <cmath>

#include "core/image_io.h"
#include "formats/load.h"
#include "render/technique_meter.h"
#include "support/gpu_fixture.h"
#include "support/shared_data.h"

namespace nephroid {
namespace {

struct Case {
  const char* technique;
  const char* scene;
  Source source;
  double fluxTolerance;  // of the flux
  double rmseTolerance;  // of the mean; the answer's own spread is part of it
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.technique << ", " << nameOf(c.source) << ", " << c.scene;
}

class TechniqueTruthGpuTest : public GpuTest, public testing::WithParamInterface<Case> {};

TEST_P(TechniqueTruthGpuTest, IsMet) {
  const Case& wanted = GetParam();
  const std::string name = wanted.scene;
  const std::filesystem::path folder = sharedData() / "truth",
                              counted = folder / (name + ".transmission.pfm"),
                              answerFile =
                                  std::filesystem::exists(counted) ? counted : folder / (name + ".pfm");
  if (!std::filesystem::exists(answerFile)) GTEST_SKIP() << "no " << answerFile;
  const Scene scene = loadScene(folder / (name + ".toml"));
  const Image answer = readPfm(answerFile);
  TechniqueSettings settings;
  settings.technique = wanted.technique;
  settings.transport.source = wanted.source;
  Progress progress;
  Stats stats;
  TechniqueMeter meter(device(), scene, scene.sensors.at(0), settings, progress, stats);
  const SensorLayer layer = meter.read();
  const std::vector<float>& truth = *answer.find("G");
  ASSERT_EQ(layer.size(), truth.size());
  double sum = 0, truthSum = 0, squares = 0;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += double(layer[i].y);
    truthSum += double(truth[i]);
    squares += std::pow(double(layer[i].y) - double(truth[i]), 2);
  }
  const double rmse = std::sqrt(squares / double(truth.size())) / (truthSum / double(truth.size()));
  EXPECT_NEAR(sum / truthSum, 1, wanted.fluxTolerance);
  EXPECT_LT(rmse, wanted.rmseTolerance);
}

// The project's own bars, as for the beams alone; a table of 129 directions leaves its own error.
constexpr Case kCases[] = {
    {"illumination-textures", "ball-point", Source::traced, 0.01, 0.05},
    {"illumination-textures", "ball-point", Source::table, 0.02, 0.2},
    {"illumination-textures", "bunny-point", Source::traced, 0.03, 0.5},
    {"illumination-textures", "spot-coloured", Source::traced, 0.03, 1.0},
    {"light-volumes", "ball-point", Source::traced, 0.01, 0.05},
    {"light-volumes", "sine-0.5", Source::traced, 0.005, 0.05},
    {"light-volumes", "sine-0.9", Source::traced, 0.005, 0.05},
    {"light-volumes", "sine-2.0", Source::traced, 0.005, 0.05},
    {"sliced-images", "ball-point", Source::traced, 0.01, 0.05},
    {"sliced-images", "ball-point", Source::table, 0.02, 0.2},
    {"sliced-images", "bunny-point", Source::traced, 0.03, 0.5},
    {"sliced-images", "spot-coloured", Source::traced, 0.03, 1.0},
};

INSTANTIATE_TEST_SUITE_P(Scenes, TechniqueTruthGpuTest, testing::ValuesIn(kCases));

}  // namespace
}  // namespace nephroid
