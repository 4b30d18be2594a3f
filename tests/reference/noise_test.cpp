// What keeps the reference's noise low changes no mean, and its noise is what it says.
#include <gtest/gtest.h>

#include "reference/draws.h"
#include "support/reference_scenes.h"
#include "trace/surface_color.h"

namespace nephroid {
namespace {

constexpr uint32_t kLooks = 16;
constexpr uint32_t kSets = 64;  // of looks

// Glass over a floor under a sky of another brightness, with no lamp.
Scene underASky(Mesh mesh) {
  Scene scene;
  scene.environment.ambient = vec3(2);
  scene.environment.background = {0.5f, 1, 5};
  scene.camera.position = {0.4f, 1.6f, 3};
  scene.camera.target = {0, 0.5f, 0};
  scene.camera.verticalFov = 24;
  add(scene, makePlane({8, 8}), diffuse(0.6f));
  add(scene, std::move(mesh), glass(), {0, 0.7f, 0});
  return scene;
}

PassLight noPhotons() {
  return {{Band{}}, PhotonMap({}, 1), PhotonMap({}, 1), 1, 1, 1, true};
}

// By a random choice at each surface, from its own numbers.
vec3 lookAtRandom(const Scene& scene, const Boundaries& boundaries, const Ray& first, Random& random) {
  Path path;
  path.direction = first.direction;
  Ray ray = first;
  Hit hit;
  while (boundaries.rayScene().intersect(ray, hit)) {
    if (!boundaries.isCaster(hit))
      return path.throughput * diffuseReflectance(scene, hit) / kPi * scene.environment.ambient;
    boundaries.send(hit, Band{}, Carried::radiance, Choice::random, random.uniform(), path);
    ray = boundaries.rayScene().leavingTriangle(hit, path.direction);
  }
  return path.throughput * scene.environment.background;
}

// Means of `kLooks` looks along the same ray, by both ways and by chance.
TEST(Noise, OfGlassIsLowWhereBothWaysAreFollowed) {
  for (Mesh& mesh : std::vector<Mesh>{makeBox({1.4f, 0.3f, 1.4f}), makeSphere(0.6f)}) {
    const Scene scene = underASky(std::move(mesh));
    const RayScene rays(scene);
    const Boundaries boundaries(scene, rays);
    const Lights lights(scene, Aim::casters);
    const Sight sight(scene, boundaries, lights);
    const Pinhole camera(scene.camera, {16, 12});
    double split = 0, chance = 0, chiSquare = 0, degrees = 0;
    for (uint32_t pixel = 0; pixel < 16 * 12; ++pixel) {
      const Ray ray = camera.rayThrough(vec2(pixel % 16, pixel / 16) + 0.5f);
      SampleMean bySplitting, byChance;
      for (uint32_t set = 0; set < kSets; ++set) {
        Random random = randomOf(1, set, pixel);
        double sums[2] = {0, 0};
        for (uint32_t look = 0; look < kLooks; ++look) {
          Draws draws(randomOf(2, set, pixel), look, kLooks);
          const Seen seen = sight.look(ray, {}, noPhotons(), draws);
          sums[0] += double((seen.direct + seen.caustics + seen.shafts + seen.rest).z) / kLooks;
          sums[1] += double(lookAtRandom(scene, boundaries, ray, random).z) / kLooks;
        }
        bySplitting.add(sums[0]);
        byChance.add(sums[1]);
      }
      split += std::pow(bySplitting.standardError(), 2);
      chance += std::pow(byChance.standardError(), 2);
      const double error = std::hypot(bySplitting.standardError(), byChance.standardError());
      const double difference = bySplitting.mean() - byChance.mean();
      EXPECT_LE(std::abs(difference), 6 * error + 1e-5 * byChance.mean()) << "pixel " << pixel;
      if (error < 1e-4 * byChance.mean()) continue;
      chiSquare += std::pow(difference / error, 2);
      ++degrees;
    }
    EXPECT_GT(degrees, 40);
    chiSquare *= (kSets - 3.0) / (kSets - 1.0);  // Student's variance
    EXPECT_LE(chiSquare, chiSquareLimit(degrees));
    EXPECT_LT(split, chance / 50);
  }
}

TEST(Noise, OfDrawsIsThatOfOneInEachPart) {
  for (const uint32_t count : {1u, 4u, 13u, 16u}) {
    SCOPED_TRACE(count);
    WeightedHistogram pairs(8 * 8), ofBranches(8 * 8);
    for (uint64_t set = 0; set < 8000; ++set) {
      std::vector<uint32_t> firstInPart(count), secondInPart(count);
      for (uint32_t index = 0; index < count; ++index) {
        Draws draws(randomOf(3, 0, set), index, count);
        const double first = double(draws.uniform()), second = double(draws.uniform());
        Draws others = draws.branch();
        const double other = double(others.uniform()), third = double(draws.uniform());
        ++firstInPart.at(binOf(first, count));
        ++secondInPart.at(binOf(second, count));
        if (set % count != index) continue;  // one of each set: the others depend on it
        pairs.add(binOf(first, 8) * 8 + binOf(second, 8));
        ofBranches.add(binOf(other, 8) * 8 + binOf(third, 8));
      }
      ASSERT_EQ(firstInPart, std::vector<uint32_t>(count, 1));
      ASSERT_EQ(secondInPart, std::vector<uint32_t>(count, 1));
    }
    pairs.expectUniform();
    ofBranches.expectUniform();
  }
}

// Which place has which part is not the same from one number to the next.
TEST(Noise, OfDrawsIsNotThatOfALine) {
  WeightedHistogram pairs(kLooks * kLooks);
  for (uint64_t set = 0; set < 20000; ++set) {
    Draws draws(randomOf(4, 0, set), uint32_t(set % kLooks), kLooks);
    const double first = double(draws.uniform());
    pairs.add(binOf(first, kLooks) * kLooks + binOf(double(draws.uniform()), kLooks));
  }
  pairs.expectUniform();
}

TEST(Noise, OfGuidedPhotonsHasWeightsThatMakeThemEven) {
  const PhotonGuide guide(std::vector<double>{0, 4, 1, 0, 100, 0, 0, 9});
  constexpr int kPhotons = 1 << 16;
  double below = 0;
  std::vector<double> sums(32, 0.0);
  for (int i = 0; i < kPhotons; ++i) {
    const PhotonGuide::Sent sent = guide.at((i + 0.5) / kPhotons);
    ASSERT_GE(sent.choice, below);
    ASSERT_LT(sent.choice, 1);
    ASSERT_LE(sent.weight, 4.0001f);  // a quarter of the photons is even
    sums.at(binOf(sent.choice, 32)) += double(sent.weight) / kPhotons;
    below = sent.choice;
  }
  for (const double sum : sums) EXPECT_NEAR(sum, 1.0 / 32, 8.0 / kPhotons);
}

// A lamp over water of which the camera sees a part, and a ball that it sees through glass.
Scene mostlyOutOfSight() {
  Scene scene;
  scene.lights = {pointLight({0.5f, 3, 0.3f}), sun({0.2f, -1, 0.1f}, 20)};
  scene.camera.position = {0, 2.2f, 2.5f};
  scene.camera.target = {0, 0, 0};
  scene.camera.verticalFov = 25;
  add(scene, makePlane({6, 6}), diffuse(0.7f));
  add(scene, makeSphere(0.3f), glass(), {0.1f, 0.5f, 0});
  add(scene, makeBox({4, 0.1f, 4}), glass(1.33f), {0.5f, 1, -0.5f});
  return scene;
}

TEST(Noise, OfGuidedPhotonsIsLowerAndTheirLightTheSame) {
  const Scene scene = mostlyOutOfSight();
  const RayScene rays(scene);
  constexpr uint32_t kPasses = 24;
  ReferenceSettings settings;
  settings.size = {64, 48};
  settings.photons = 1 << 15;
  ReferenceImage guided(scene, rays, settings);
  settings.pilots = 0;
  settings.seed = 2;
  ReferenceImage even(scene, rays, settings);
  const auto byGuide = blockMeans(guided, {"caustics.G"}, kPasses, 8);
  const auto evenly = blockMeans(even, {"caustics.G"}, kPasses, 8);
  double ofGuided = 0, ofEven = 0, chiSquare = 0, degrees = 0;
  for (std::size_t block = 0; block < evenly[0].size(); ++block) {
    const SampleMean &a = byGuide[0][block], &b = evenly[0][block];
    ofGuided += std::pow(a.standardError(), 2);
    ofEven += std::pow(b.standardError(), 2);
    if (b.mean() <= 10 * b.standardError()) continue;
    chiSquare +=
        std::pow(a.mean() - b.mean(), 2) / (std::pow(a.standardError(), 2) + std::pow(b.standardError(), 2));
    ++degrees;
  }
  EXPECT_GT(degrees, 20);
  EXPECT_LE(chiSquare * (kPasses - 3.0) / (kPasses - 1.0), chiSquareLimit(degrees));
  EXPECT_LT(ofGuided, 0.5 * ofEven);
}

// The spread of many results, each of a few passes, against the variance that they say they have.
TEST(Noise, IsWhatTheVarianceSays) {
  Scene scene = mostlyOutOfSight();
  scene.environment.background = vec3(3);
  scene.environment.ambient = vec3(1);
  const RayScene rays(scene);
  constexpr uint64_t kResults = 48;
  constexpr uint32_t kPasses = 6;
  ReferenceSettings settings;
  settings.size = {24, 18};
  settings.photons = 1 << 12;
  std::vector<SampleMean> results(24 * 18);
  double said = 0, seen = 0;
  for (settings.seed = 1; settings.seed <= kResults; ++settings.seed) {
    ReferenceImage estimate(scene, rays, settings);
    runPasses(estimate, kPasses);
    const Image image = estimate.image();
    for (std::size_t i = 0; i < results.size(); ++i) {
      results[i].add(double((*image.find("G"))[i]));
      said += double((*image.find("variance.G"))[i]) / kResults;
    }
  }
  for (const SampleMean& result : results) seen += std::pow(result.standardError(), 2) * kResults;
  EXPECT_NEAR(seen / said, 1, 0.15);
}

}  // namespace
}  // namespace nephroid
