// The air and the lights of cues, as scene files say them and as the host computes them.
#include <cmath>
#include <random>

#include "core/progress.h"
#include "formats/load.h"
#include "lights/light_in_air.h"
#include "lights/light_intensity.h"
#include "render/measure.h"
#include "scene/air.h"
#include "support/reference_scenes.h"
#include "support/scratch_files.h"

namespace nephroid {
namespace {

Medium fog(float base, float height) {
  Medium medium;
  medium.extinction = 0.2f;
  medium.albedo = 0.7f;
  medium.fogBase = base;
  medium.fogHeight = height;
  return medium;
}

// Integral of the density's extinction by many small steps.
double summedDepth(const Medium& air, glm::dvec3 from, glm::dvec3 direction, double length) {
  constexpr int kSteps = 20000;
  double sum = 0;
  for (int i = 0; i < kSteps; ++i) {
    const vec3 point(from + (i + 0.5) / kSteps * length * direction);
    sum += double(air.grid ? densityAt(*air.grid, point) : fogDensity(airOf(air), point.y)) / kSteps;
  }
  return double(air.extinction) * length * sum;
}

TEST(Air, ThinsOutUpward) {
  const Medium air = fog(1, 2);
  EXPECT_EQ(fogDensity(airOf(air), 0.5f), 1);
  EXPECT_NEAR(fogDensity(airOf(air), 3), std::exp(-1), 1e-6);
  for (const vec3 direction :
       {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0.6f, -0.8f, 0), normalize(vec3(1, 0.01f, 0.3f))})
    for (const float height : {-1.0f, 0.9f, 2.5f}) {
      const double expected = summedDepth(air, {0, height, 0}, direction, 4);
      EXPECT_NEAR(opticalDepth(air, {0, height, 0}, direction, 4), expected, 2e-4 * expected);
    }
  EXPECT_NEAR(opticalDepth(air, {0, 1, 0}, {0, 1, 0}, INFINITY), 0.2 * 2, 1e-6);
}

TEST(Air, OfAGridIsTheSumOverItsCells) {
  Medium air = fog(0, 0);
  air.grid = DensityGrid{"noise", {-1, 0, -1}, {2, 1, 3}, {12, 7, 16}, {}};
  fillWithNoise(*air.grid, {.feature = 0.8f, .octaves = 3, .seed = 4, .clear = 0.2f});
  std::mt19937 random(3);
  std::uniform_real_distribution<float> coordinate(-2, 2);
  for (int i = 0; i < 20; ++i) {
    const vec3 from(coordinate(random), coordinate(random), coordinate(random));
    const vec3 to =
        vec3(0, 0.5f, 0) + 0.3f * vec3(coordinate(random), coordinate(random), coordinate(random));
    const vec3 direction = normalize(to - from);
    const double expected = summedDepth(air, from, direction, 6);
    // Two steps in each cell, over which density is linear in each direction.
    EXPECT_NEAR(opticalDepth(air, from, direction, 6), expected, 0.02 * expected + 1e-4);
  }
  EXPECT_EQ(opticalDepth(air, {0, 5, 0}, {1, 0, 0}, INFINITY), 0);
}

TEST(Air, OfAGridOfOneDensityIsEven) {
  Medium air = fog(0, 0);
  air.grid = DensityGrid{"even", {-1, -1, -1}, {2, 2, 2}, {3, 1, 2}, std::vector<float>(6, 0.5f)};
  EXPECT_NEAR(opticalDepth(air, {-3, 0.2f, 0.3f}, {1, 0, 0}, 10), 0.2 * 0.5 * 2, 1e-6);
}

// What leaves the lamp is scattered or absorbed on its way, or arrives at the walls.
TEST(Air, KeepsLumensInAClosedBox) {
  for (const bool isFog : {false, true}) {
    Scene scene;
    scene.medium = isFog ? fog(-0.5f, 0.6f) : fog(0, 0);
    Light spot = spotLight({0.2f, 0.3f, -0.1f}, {0.5f, -1, 0.2f}, 30, 50, 100);
    scene.lights = {spot};
    const ShapedLight shaped = shapedLight(scene, spot);
    constexpr double kSide = 2;
    double taken = 0;
    constexpr int kCells = 96;
    for (int z = 0; z < kCells; ++z)
      for (int y = 0; y < kCells; ++y)
        for (int x = 0; x < kCells; ++x) {
          const vec3 point = (vec3(x, y, z) + 0.5f) / float(kCells) * float(kSide) - float(kSide / 2);
          const Emitter emitter = emittersOf(scene).front();
          const double lux =
              double(illuminance(shaped, emitter, point).y * airTransmittance(scene, emitter, point));
          taken += lux * double(scatteringAt(*scene.medium, point) / scene.medium->albedo);
        }
    taken *= std::pow(kSide / kCells, 3);

    const RayScene rays(scene);
    Progress progress;
    double arriving = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const float side : {-1.0f, 1.0f}) {
        // Faces cross(v, u), inward.
        vec3 u(0), v(0), corner(-1);
        u[(axis + 1) % 3] = v[(axis + 2) % 3] = float(kSide);
        corner[axis] = side;
        if (side < 0) std::swap(u, v);
        const Sensor wall{"wall", corner, u, v, uvec2(64)};
        ASSERT_LT(wall.normal()[axis] * side, 0);
        for (const vec3 lux : measureDirect(scene, rays, wall, 0.01f, progress))
          arriving += double(lux.y) * kSide * kSide / (64 * 64);
      }
    const double cosInner = std::cos(glm::radians(30.0)), cosOuter = std::cos(glm::radians(50.0));
    const double emitted = 100 * 2 * double(kPi) * (1 - cosInner + (cosInner - cosOuter) / 3);
    EXPECT_GT(taken, 0.05 * emitted);
    EXPECT_NEAR(taken + arriving, emitted, 0.01 * emitted) << taken << " + " << arriving;
  }
}

class CueFile : public ScratchFiles {
 protected:
  Light spotAt(double time, const std::string& keys) const {
    return loadScene(write("cue.toml", "[[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\n" + keys), time)
        .lights.at(0);
  }
  void expectError(const std::string& toml, const std::vector<std::string>& parts) const {
    const std::string error = inputErrorOf([&] { loadScene(write("wrong.toml", toml)); });
    for (const std::string& part : parts)
      EXPECT_NE(error.find(part), std::string::npos) << error << "\nlacks: " << part;
  }
};

double lumensOf(const Light& light) {
  const SpotCone cone = coneOf(light);
  double sum = 0;
  constexpr int kSteps = 200000;
  for (int i = 0; i < kSteps; ++i) {
    const double cosine = (i + 0.5) / kSteps;
    sum += double(light.intensity.y) * double(coneFalloff(float(cosine), cone.scale, cone.offset));
  }
  return 2 * double(kPi) * sum / kSteps;
}

TEST_F(CueFile, OpeningAConeSpreadsTheSameLumens) {
  const std::string cue =
      "direction = [0, -1, 0]\nflux = 1200\ninner_angle = 10\nouter_angle = 20\nzoom = [[1, 20], [3, 60]]\n";
  for (const double time : {0.0, 1.5, 2.0, 9.0}) EXPECT_NEAR(lumensOf(spotAt(time, cue)), 1200, 2) << time;
  EXPECT_EQ(spotAt(2, cue).outerAngle, 40);
  EXPECT_EQ(spotAt(2, cue).innerAngle, 20);
  EXPECT_EQ(spotAt(9, cue).outerAngle, 60);
}

TEST_F(CueFile, TurnsTiltsAndDims) {
  const std::string cue =
      "direction = [0, 0, -1]\nintensity = 100\npan = [[0, 0], [2, 90]]\ntilt = -30\n"
      "dimmer = [[0, 1], [1, 0.5], [2, 0]]\n";
  const vec3 tilted(0, -0.5f, -std::sqrt(0.75f));
  EXPECT_LT(distance(spotAt(0, cue).direction, tilted), 1e-6f);
  EXPECT_LT(distance(spotAt(2, cue).direction, vec3(-std::sqrt(0.75f), -0.5f, 0)), 1e-6f);
  EXPECT_NEAR(spotAt(0.5, cue).intensity.x, 75, 1e-4);
  EXPECT_EQ(spotAt(2, cue).intensity, vec3(0));
}

TEST_F(CueFile, NamesTheLineOfAFileThatIsBroken) {
  write("broken.png", "not a picture");
  write("broken.ies", "IESNA:LM-63-2002\nTILT=NONE\n1 2 three\n");
  const std::string spot =
      "[[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\nintensity = 1\n";
  expectError(spot + "gobo = \"broken.png\"\n", {"wrong.toml:6", "\"gobo\"", "broken.png"});
  expectError(spot + "ies = \"broken.ies\"\n", {"wrong.toml:6", "\"ies\"", "broken.ies:3"});
  expectError(spot + "gobo = \"none.png\"\n", {"wrong.toml:6", "\"gobo\"", "none.png"});
}

TEST_F(CueFile, SaysWhatIsWrong) {
  const std::string spot = "[[light]]\ntype = \"spot\"\nposition = [0, 3, 0]\ndirection = [0, -1, 0]\n";
  expectError(spot + "intensity = 1\npan = [[0, 1], [0, 2]]\n", {":6", "\"pan\"", "ascend"});
  expectError(spot + "intensity = 1\npan = [[0, 1, 2]]\n", {":6", "[time, value]"});
  expectError(spot + "intensity = 1\npan = []\n", {":6", "empty"});
  expectError(spot + "intensity = 1\ndimmer = -1\n", {":6", "\"dimmer\""});
  expectError(spot + "intensity = 1\nflux = 2\n", {":6", "\"flux\"", "\"intensity\""});
  expectError(spot + "intensity = 1\ngobo_rotation = 2\n", {":6", "\"gobo\""});
  expectError(spot + "intensity = 1\nzoom = 95\n", {":6", "\"zoom\""});
  expectError("[[light]]\ntype = \"point\"\nposition = [0, 3, 0]\nintensity = 1\npan = 3\n",
              {":5", "\"pan\""});
  const std::string air = "[medium]\nextinction = 1\n[medium.noise]\ncorner = [0, 0, 0]\n";
  expectError(air, {"\"size\""});
  expectError(air + "size = [1, 1, 1]\ncells = [300, 1, 1]\n", {":6", "\"cells\""});
  expectError(air + "size = [1, 1, 1]\ncells = [1.5, 1, 1]\n", {":6", "\"cells\""});
  expectError("[medium]\nextinction = 1\nfog_height = 0\n", {":3", "\"fog_height\""});
  expectError("[medium]\nextinction = 1\nfog_base = 2\n", {":3", "\"fog_base\""});
}

}  // namespace
}  // namespace nephroid
