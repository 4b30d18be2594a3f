// The beams alone against independently counted photons and exact mappings.
#include <gtest/gtest.h>

#include "support/counted_answers.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

struct Case {
  const char* scene;
  const char* answer;
  Paths paths;
  uint32_t refineDepth;
  double fluxTolerance;  // of the flux
  double rmseTolerance;  // of the mean; the answer's own spread is part of it
};

void PrintTo(const Case& c, std::ostream* out) {
  *out << c.answer;
}

class Truth : public testing::TestWithParam<Case> {};

TEST_P(Truth, IsMetByTheBeamsAlone) {
  const Case& wanted = GetParam();
  const std::filesystem::path answer = truthFile(wanted.answer);
  if (!std::filesystem::exists(answer)) GTEST_SKIP() << "no " << answer;
  const Scene scene = truthScene(wanted.scene);
  const RayScene rays(scene);
  Progress progress;
  Stats stats;
  expectCounted(measureBeams(scene, rays, TracedSource(scene, rays), scene.sensors.at(0), wanted.paths,
                             wanted.refineDepth, progress, stats),
                answer, wanted.fluxTolerance, wanted.rmseTolerance);
}

// Tolerances are the project's own bars: 1 % of the flux and 5 % for balls of 25,600 vertices, 3 % of the
// flux for scanned meshes, whose sharp folds leave a texel's worth of difference at every line; 0.5 % of the
// flux for waves.
constexpr Case kCases[] = {
    {"ball-point", "ball-point.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"ball-point", "ball-point.all.pfm", Paths::all, 1, 0.01, 0.05},
    {"ball-sun-0.6", "ball-sun-0.6.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"ball-sun-0.75", "ball-sun-0.75.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"ball-sun-0.75", "ball-sun-0.75.all.pfm", Paths::all, 1, 0.01, 0.05},
    {"ball-sun-1.2", "ball-sun-1.2.transmission.pfm", Paths::transmission, 1, 0.01, 0.05},
    {"bunny-point", "bunny-point.transmission.pfm", Paths::transmission, 2, 0.03, 0.5},
    {"spot-coloured", "spot-coloured.transmission.pfm", Paths::transmission, 2, 0.03, 1.0},
    {"mirror-ring", "mirror-ring.all.pfm", Paths::all, 1, 0.01, 0.15},
    {"sine-0.5", "sine-0.5.pfm", Paths::transmission, 1, 0.005, 0.05},
    {"sine-0.9", "sine-0.9.pfm", Paths::transmission, 1, 0.005, 0.05},
    {"sine-2.0", "sine-2.0.pfm", Paths::transmission, 1, 0.005, 0.05},
};

INSTANTIATE_TEST_SUITE_P(Scenes, Truth, testing::ValuesIn(kCases));

}  // namespace
}  // namespace nephroid
