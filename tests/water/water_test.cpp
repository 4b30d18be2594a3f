#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "formats/load.h"
#include "geometry/shapes.h"
#include "support/scratch_files.h"
#include "transport/scene_transport.h"
#include "water/ocean.h"
#include "water/water.h"
#include "water/wave_simulation.h"

namespace nephroid {
namespace {

constexpr double kPi = std::numbers::pi;

// The lowest standing wave between two sides 2 m apart, at its highest.
WaveField standingWave(double damping) {
  WaveField field;
  field.grid = {101, 5};
  field.spacing = {0.02, 0.02};
  field.speed = 1.5;
  field.damping = damping;
  field.step = 0.3 * stableStep(field.spacing, field.speed);
  const double frequency = field.speed * kPi / 2;
  for (uint32_t z = 0; z < field.grid.y; ++z)
    for (uint32_t x = 0; x < field.grid.x; ++x) {
      const double shape = 0.01 * std::cos(kPi * x / 100.0);
      field.heights.push_back(shape);
      field.before.push_back(shape * std::cos(frequency * field.step));
    }
  return field;
}

TEST(WaveSimulation, AStandingWaveHasThePeriodOfItsLengthOverItsSpeed) {
  WaveField field = standingWave(0);
  const double period = 4 / field.speed;
  // Its middle third of a period apart: -1/2 of what it was.
  const auto steps = int(std::lround(period / 3 / field.step));
  for (int i = 0; i < steps; ++i) advance(field);
  const double angle = 2 * kPi * steps * field.step / period;
  for (uint32_t x = 0; x < field.grid.x; ++x)
    EXPECT_NEAR(field.heights[x], 0.01 * std::cos(kPi * x / 100.0) * std::cos(angle), 1e-5);
}

TEST(WaveSimulation, EnergyIsKeptAndDampingTakesItAtItsRate) {
  for (const double damping : {0.0, 0.5}) {
    WaveField field = standingWave(damping);
    const double before = energy(field), seconds = 4;
    const auto steps = int(std::lround(seconds / field.step));
    for (int i = 0; i < steps; ++i) advance(field);
    const double expected = before * std::exp(-damping * steps * field.step);
    // Of damped waves half the energy, the moving one, is lost at twice the rate: it swings about the mean.
    EXPECT_NEAR(energy(field) / expected, 1, damping > 0 ? damping / (field.speed * kPi / 2) : 1e-9);
  }
}

Water simulatedPool() {
  Water water;
  water.size = {4, 4};
  water.grid = {101, 101};
  water.simulation.emplace();
  return water;
}

TEST(WaveSimulation, ADropsRingRunsAtTheWavesSpeedAndKeepsTheVolume) {
  Water water = simulatedPool();
  water.simulation->speed = 0.8f;
  water.simulation->drops = {{0.5f, {0, 0}, 0.1f, 0.02f}};
  EXPECT_EQ(simulatedHeights(water, 0.4)[50 * 101 + 50], 0);
  const std::vector<double> heights = simulatedHeights(water, 1.75);  // a ring of 1 m
  EXPECT_NEAR(std::accumulate(heights.begin(), heights.end(), 0.0), 0, 1e-6);
  double highest = 0;
  uint32_t place = 0;
  for (uint32_t x = 50; x < 101; ++x)
    if (std::abs(heights[50 * 101 + x]) > highest) highest = std::abs(heights[50 * 101 + x]), place = x;
  EXPECT_GT(highest, 1e-4);
  EXPECT_NEAR((place - 50) * 0.04, 1, 0.12);                    // within the drop's own radius
  EXPECT_LT(std::abs(heights[50 * 101 + 90]), 0.02 * highest);  // nothing runs ahead
}

// Twice as fast as waves run, it leaves them within 30 degrees of its track (Mach).
TEST(WaveSimulation, AFastObstacleLeavesWavesInItsWakeAlone) {
  Water water = simulatedPool();
  water.simulation->obstacles = {{0.1f, 0.05f, {{-0.8f, 0, 0}, {1.2f, 0, 1}}}};
  const std::vector<double> heights = simulatedHeights(water, 0.8);  // it is at x = 0.8
  const auto at = [&](double x, double z) {
    return heights[std::size_t(std::lround((z + 2) / 0.04) * 101 + std::lround((x + 2) / 0.04))];
  };
  EXPECT_GT(std::abs(at(0, 0.8 * std::tan(kPi / 6))), 0.001);
  EXPECT_NEAR(at(1.4, 0), 0, 1e-5);
  EXPECT_NEAR(at(0, 1.2), 0, 1e-5);
  for (uint32_t z = 0; z < 101; ++z) EXPECT_NEAR(heights[z * 101 + 40], heights[(100 - z) * 101 + 40], 1e-9);
  EXPECT_NEAR(std::accumulate(heights.begin(), heights.end(), 0.0), 0, 1e-4);
}

void expectAsFresh(WaveRun& run, const Water& water, double time, uint64_t mostSteps) {
  const uint64_t before = run.steps();
  EXPECT_EQ(run.heightsAt(water, time), simulatedHeights(water, time)) << time << " s";
  EXPECT_LE(run.steps() - before, mostSteps) << time << " s";
}

TEST(WaveRuns, GoOnToWhatAFreshRunComesTo) {
  Water water = simulatedPool();
  water.simulation->damping = 0.2f;
  water.simulation->drops = {{0.1f, {0.3f, 0}, 0.1f, 0.02f}, {0.4f, {-0.5f, 0.2f}, 0.2f, 0.01f}};
  water.simulation->obstacles = {{0.1f, 0.05f, {{-0.8f, 0, 0.2f}, {1.2f, 0, 1}, {1, 1, 2}}}};
  const double step = 1 / simulationSteps(water, 1);
  const auto stepsOf = [&](double seconds) { return uint64_t(seconds / step) + 2; };
  WaveRun run;
  expectAsFresh(run, water, 0.3, stepsOf(0.3));
  for (double time = 0.3; time < 0.6; time += 1 / 60.0) expectAsFresh(run, water, time, stepsOf(1 / 60.0));
  expectAsFresh(run, water, 0.6 + 0.1 * step, stepsOf(1 / 60.0));
  expectAsFresh(run, water, 0.6 + 0.2 * step, 1);
  expectAsFresh(run, water, 45 * step, stepsOf(0.1));  // at the end of a step
  expectAsFresh(run, water, 0.2, stepsOf(0.2));        // back
}

TEST(WaveRuns, BeginAgainWhereThePastChangedAndNotForTheFuture) {
  Water water = simulatedPool();
  water.simulation->drops = {{0.1f, {0.3f, 0}, 0.1f, 0.02f}};
  water.simulation->obstacles = {{0.1f, 0.05f, {{-0.8f, 0, 0}, {1.2f, 0, 2}}}};
  WaveRun run;
  expectAsFresh(run, water, 0.5, 1000);
  water.simulation->drops.push_back({0.5f, {-0.5f, 0}, 0.1f, 0.02f});  // now
  expectAsFresh(run, water, 0.52, 4);
  water.simulation->obstacles[0].path.push_back({0, 0, 3});
  water.simulation->obstacles.push_back({0.2f, 0.05f, {{0, 0, 1}, {0, 1, 2}}});
  expectAsFresh(run, water, 0.54, 4);
  const auto expectAnew = [&] {
    const uint64_t before = run.steps();
    expectAsFresh(run, water, 0.56, 1000);
    EXPECT_GT(run.steps() - before, 20u);
  };
  water.simulation->drops[0].depth = 0.03f;
  expectAnew();
  water.simulation->obstacles[0].path[0].x = -0.7f;
  expectAnew();
  water.simulation->speed = 1.1f;
  expectAnew();
  water.size = {3, 4};
  expectAnew();
}

class WaveRunsOfFiles : public ScratchFiles {};

TEST_F(WaveRunsOfFiles, AreOfEachObjectOfASceneThatIsLoadedAtOneTimeAfterAnother) {
  const std::filesystem::path file = write("two.toml", R"(
[[material]]
name = "water"
type = "dielectric"
[[object]]
shape = "water"
material = "water"
grid = [9, 9]
simulation = { drops = [{ time = 0, radius = 0.2 }] }
[[object]]
shape = "water"
material = "water"
grid = [17, 9]
simulation = { drops = [{ time = 0.1, radius = 0.2 }] }
)");
  WaveRuns waves;
  for (const double time : {0.5, 0.6}) {
    const Scene kept = loadScene(file, time, &waves), fresh = loadScene(file, time);
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_EQ(kept.meshes[i].positions, fresh.meshes[i].positions) << i << ", " << time << " s";
  }
  ASSERT_EQ(waves.size(), 2u);
  EXPECT_LE(waves[1].steps(), uint64_t(simulationSteps(*loadScene(file).objects[1].water, 0.6)) + 3);
}

Water sea() {
  Water water;
  water.size = {40, 30};
  water.grid = {65, 49};
  water.ocean.emplace();
  water.ocean->wind = {6, 2};
  water.ocean->significantHeight = 0.4f;
  return water;
}

// What the grid has of the wave of whole numbers of turns along its sides.
std::complex<double> coefficient(const std::vector<double>& heights, uvec2 grid, int turnsX, int turnsZ) {
  const uvec2 cells = grid - 1u;
  std::complex<double> sum = 0;
  for (uint32_t z = 0; z < cells.y; ++z)
    for (uint32_t x = 0; x < cells.x; ++x)
      sum += heights[z * grid.x + x] *
             std::polar(1.0, -2 * kPi * (double(turnsX) * x / cells.x + double(turnsZ) * z / cells.y));
  return sum / double(cells.x * cells.y);
}

// Waves along a vector and against it both turn at the frequency of their length.
TEST(Ocean, EachWaveHasTheFrequencyOfItsLengthAndDepth) {
  for (const float depth : {std::numeric_limits<float>::infinity(), 2.0f}) {
    Water water = sea();
    water.ocean->depth = depth;
    const double step = 0.2;
    const std::vector<double> before = oceanSurface(water, 3 - step).heights,
                              now = oceanSurface(water, 3).heights,
                              after = oceanSurface(water, 3 + step).heights;
    for (const auto& [x, z] : {std::pair{3, 1}, {5, -1}, {7, 4}, {2, 0}}) {
      const double k = 2 * kPi * std::hypot(x / 40.0, z / 30.0);
      const double omega = std::sqrt(9.81 * k * std::tanh(k * double(depth)));
      const std::complex<double> middle = coefficient(now, water.grid, x, z);
      ASSERT_GT(std::abs(middle), 1e-6);
      const std::complex<double> sides =
          coefficient(before, water.grid, x, z) + coefficient(after, water.grid, x, z);
      EXPECT_NEAR(std::abs(sides / (2.0 * middle) - std::cos(omega * step)), 0, 1e-6) << x << " " << z;
    }
  }
}

TEST(Ocean, VarianceIsThatOfTheSignificantHeight) {
  Water water = sea();
  EXPECT_NEAR(16 * oceanVariance(water), 0.16, 1e-6);
  constexpr int kSeas = 60;
  double sum = 0, squares = 0;
  for (uint32_t seed = 0; seed < kSeas; ++seed) {
    water.ocean->seed = seed;
    const OceanSurface surface = oceanSurface(water, 1.7);
    double variance = 0;
    for (uint32_t z = 0; z + 1 < water.grid.y; ++z)
      for (uint32_t x = 0; x + 1 < water.grid.x; ++x)
        variance += std::pow(surface.heights[z * water.grid.x + x], 2) / (64 * 48);
    sum += variance;
    squares += variance * variance;
  }
  const double mean = sum / kSeas, deviation = std::sqrt((squares / kSeas - mean * mean) / kSeas);
  EXPECT_NEAR(mean, 0.01, 4 * deviation);
  EXPECT_LT(deviation, 0.0015);
}

// Over all frequencies JONSWAP, with a peak enhanced 3.3 times, has 0.305 alpha g^2 / peak^4 (Hasselmann et
// al. 1973).
TEST(Ocean, TheWindMakesTheHeightThatItsFetchAllows) {
  Water water;
  water.size = {1000, 1000};
  water.grid = {257, 257};
  water.ocean.emplace();
  water.ocean->wind = {10, 0};
  water.ocean->fetch = 1e5f;
  const double alpha = 0.076 * std::pow(100 / (1e5 * 9.81), 0.22), peak = 22 * std::cbrt(9.81 * 9.81 / 1e6);
  EXPECT_NEAR(oceanVariance(water) / (0.305 * alpha * 9.81 * 9.81 / std::pow(peak, 4)), 1, 0.03);
}

TEST(Ocean, TheSameSeedGivesTheSameSeaOnAnyGrid) {
  Water water = sea();
  const OceanSurface one = oceanSurface(water, 2), again = oceanSurface(water, 2);
  EXPECT_EQ(one.heights, again.heights);
  water.ocean->seed = 1;
  EXPECT_NE(one.heights, oceanSurface(water, 2).heights);
  water.ocean->seed = 0;
  // As without the override, whose scale depends on the waves that the grid holds.
  water.ocean->significantHeight = 0;
  const std::vector<double> coarse = oceanSurface(water, 2).heights;
  const uvec2 grid = water.grid;
  water.grid = {129, 97};
  EXPECT_NEAR(std::abs(coefficient(coarse, grid, 4, 1) -
                       coefficient(oceanSurface(water, 2).heights, water.grid, 4, 1)),
              0, 1e-9);
}

// Facets of a fine surface, choppy or not, look where its normals do.
TEST(Ocean, NormalsAreThoseOfTheSurface) {
  for (const float choppiness : {0.0f, 0.8f}) {
    Water water = sea();
    water.size = {10, 10};
    water.grid = {401, 401};
    water.ocean->wind = {3, 0};
    water.ocean->significantHeight = 0.1f;
    water.ocean->choppiness = choppiness;
    const Mesh mesh = makeWater(water, 0.5);
    double worst = 0;
    for (uint32_t z = 20; z < 380; z += 13)
      for (uint32_t x = 20; x < 380; x += 13) {
        const auto at = [&](uint32_t i, uint32_t j) { return mesh.positions[j * 401 + i]; };
        const vec3 facet = normalize(cross(at(x, z + 1) - at(x, z - 1), at(x + 1, z) - at(x - 1, z)));
        worst = std::max(worst, double(length(facet - mesh.normals[z * 401 + x])));
      }
    EXPECT_LT(worst, 0.1);
  }
}

TEST(Ocean, ChoppinessSharpensCrests) {
  Water water = sea();
  const auto skewness = [&] {
    const Mesh mesh = makeWater(water, 1);
    // The mean over where the surface has come to: wide troughs, narrow crests.
    double area = 0, sum = 0;
    for (const uvec3& t : mesh.triangles) {
      const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
      const double part = double((c.x - a.x) * (b.z - a.z) - (b.x - a.x) * (c.z - a.z));
      area += std::abs(part);
      sum += std::abs(part) * double(a.y + b.y + c.y) / 3;
    }
    return sum / area;
  };
  const double smooth = skewness();
  water.ocean->choppiness = 1;
  EXPECT_LT(skewness(), smooth - 1e-3);
}

// The rays of a scene that is there meet the water where it has moved to.
TEST(MovingWater, IsWhereItIsInTheTransport) {
  Scene scene;
  scene.materials.resize(1);
  scene.materials[0].type = MaterialType::dielectric;
  Water water{{2, 2}, {51, 51}, {{0.05f, 1, {1, 0}, 0.4f, 0}}};
  scene.meshes = {makeWater(water, 0)};
  scene.objects.resize(1);
  scene.objects[0].water = water;
  Progress progress;
  SceneTransport transport(scene, TransportSettings{}, progress);
  for (const double time : {0.0, 0.7, 1.1}) {
    scene.meshes[0] = makeWater(water, time);
    transport.place(scene);
    Hit hit;
    ASSERT_TRUE(transport.rayScene().intersect({{0.31f, 1, 0.1f}, {0, -1, 0}}, hit));
    EXPECT_NEAR(double(hit.position.y), waterAt(water, {0.31, 0.1}, time).height, 1e-4) << time;
  }
}

class WaterScene : public ScratchFiles {
 protected:
  void SetUp() override {
    ScratchFiles::SetUp();
    write("0.obj", "v 0 0 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n");
    write("1.obj", "v 0 0.5 0\nv 1 0 0\nv 0 0 1\nf 1 3 2\n");
  }
  Scene load(const std::string& keys, double time) {
    const std::string start =
        "[[material]]\nname = \"w\"\ntype = \"dielectric\"\nior = 1.33\n"
        "[[object]]\nmaterial = \"w\"\nshape = \"water\"\n";
    return loadScene(write("water.toml", start + keys), time);
  }
  std::string errorOf(const std::string& keys) {
    return inputErrorOf([&] { load(keys, 0); });
  }
};

TEST_F(WaterScene, ReadsSimulationsSeasAndSequences) {
  const Scene pool = load(
      "grid = [20, 20]\nsimulation = {speed = 2, damping = 0.1, drops = [{time = 1, position = [0.1, 0], "
      "radius = 0.05, "
      "depth = 0.01}], obstacles = [{radius = 0.1, depth = 0.02, path = [[0, 0, 0], [0.2, 0, 1]]}]}\n"
      "ocean = {spectrum = \"phillips\", wind = [3, 1], significant_height = 0.02, choppiness = 0.5, seed = "
      "4}\n",
      1.5);
  ASSERT_TRUE(pool.objects[0].water->simulation && pool.objects[0].water->ocean);
  EXPECT_EQ(pool.objects[0].water->simulation->obstacles[0].path.size(), 2u);
  EXPECT_EQ(pool.meshOf(pool.objects[0]).positions.size(), 400u);
  EXPECT_EQ(load("sequence = \"#.obj\"\nfps = 10\n", 0.1).meshes[0].positions[0].y, 0.5f);
}

TEST_F(WaterScene, TellsWhatIsWrong) {
  EXPECT_NE(errorOf("simulation = {sped = 1}\n").find("speed"), std::string::npos);
  EXPECT_NE(errorOf("simulation = {obstacles = [{radius = 1}]}\n").find("path"), std::string::npos);
  EXPECT_NE(errorOf("simulation = {obstacles = [{path = [[0, 0, 1], [0, 0, 1]]}]}\n").find("rise"),
            std::string::npos);
  EXPECT_NE(errorOf("ocean = {wind = [0, 0]}\n").find("wind"), std::string::npos);
  EXPECT_NE(errorOf("ocean = {spectrum = \"jonswop\"}\n").find("jonswap"), std::string::npos);
  EXPECT_NE(errorOf("sequence = \"0.obj\"\n").find('#'), std::string::npos);
  EXPECT_NE(errorOf("sequence = \"#.obj\"\ngrid = [2, 2]\n").find("grid"), std::string::npos);
  EXPECT_NE(errorOf("sequence = \"##.obj\"\n").find("00.obj"), std::string::npos);
}

}  // namespace
}  // namespace nephroid
