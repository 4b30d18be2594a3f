// Techniques against independently counted photons, read as a camera would see a receiver in the sensor's
// place.
#include "support/counted_answers.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"

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
  std::filesystem::path answer = truthFile(name + ".transmission.pfm");
  if (!std::filesystem::exists(answer)) answer = truthFile(name + ".pfm");
  if (!std::filesystem::exists(answer)) GTEST_SKIP() << "no " << answer;
  const Scene scene = truthScene(name);
  expectCounted(measuredBy(device(), scene, scene.sensors.at(0), settingsOf(wanted.technique, wanted.source)),
                answer, wanted.fluxTolerance, wanted.rmseTolerance);
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
