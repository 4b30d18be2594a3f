#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "geometry/shapes.h"
#include "irradiance_volume/grid.h"
#include "irradiance_volume/harmonics.h"
#include "irradiance_volume/lookup.h"
#include "support/closed_forms.h"
#include "support/irradiance_volumes.h"

namespace nephroid {
namespace {

constexpr float kDisc = 0.5f;  // m, radius of the discs that flux is counted through

// Lumens through a disc across the unit vector `axis`, by points spread evenly over it.
double fluxThrough(IrradianceVolume& volume, vec3 light, vec3 center, vec3 axis, float disc = kDisc) {
  constexpr int kPoints = 40000;
  const mat3 frame = sampleFrame(axis);
  double lux = 0;
  for (int i = 0; i < kPoints; ++i) {
    const float radius = disc * std::sqrt((float(i) + 0.5f) / kPoints), angle = 2.3999632f * float(i);
    const vec3 point = center + radius * (std::cos(angle) * frame[0] + std::sin(angle) * frame[1]);
    lux += double(volume.illuminance(point, -axis, light, LightInterpolation::rotated).y) / kPoints;
  }
  return lux * std::numbers::pi * double(disc * disc);
}

// The same by counting photons.
double photonsThrough(const CasterTracer& tracer, vec3 light, vec3 center, vec3 axis) {
  const float radius = tracer.sphere().radius;
  const mat3 frame = sampleFrame(light);
  double flux = 0;
  for (const PhotonPath& path : tracer.trace(light, 60000, 4)) {
    const vec3 origin = tracer.sphere().center + radius * (frame * path.origin);
    const vec3 direction = frame * path.direction;
    const float along = dot(center - origin, axis) / dot(direction, axis);
    if (along < 0 || along > radius * path.length || dot(direction, axis) <= 0) continue;
    if (length(origin + along * direction - center) < kDisc) flux += double(path.flux.y * radius * radius);
  }
  return flux;
}

class IrradianceVolumeAs : public testing::TestWithParam<uint32_t> {
 protected:
  static VolumeSettings settings(uint32_t kilobytes, uint32_t photons) {
    VolumeSettings settings = someSettings();
    settings.representation = GetParam();
    settings.error = settings.representation == kRepresentationMultiResolution ? 5 : 0;
    settings.kilobytes = kilobytes;
    settings.photons = photons;
    return settings;
  }
  const Mesh ball = makeSphere(0.5f, {.vertices = 6000});
  const Material glass_ = glass();
  const Material silver_ = silver();
};

// Through discs behind a glass ball, at, before and beyond its focus (1.5 radii from the center), straight
// and oblique.
TEST_P(IrradianceVolumeAs, KeepsTheFluxOfABall) {
  IrradianceVolume volume(ball, glass(), settings(120, 30), {});
  const vec3 light = normalize(vec3(0.3f, -1, 0.2f));
  for (const float distance : {0.6f, 0.75f, 0.9f, 1.1f}) {
    const double flux = ballLensRings(0.5, double(distance), 1.5, double(kDisc), 1)[0];
    EXPECT_NEAR(fluxThrough(volume, light, distance * light, light) / flux, 1, 0.03) << distance;
  }
  const vec3 tilted = normalize(light + 0.4f * sampleFrame(light)[0]);
  const double flux =
      photonsThrough(CasterTracer(ball, glass_, Paths::transmission), light, 0.85f * light, tilted);
  EXPECT_NEAR(fluxThrough(volume, light, 0.85f * light, tilted) / flux, 1, 0.03);
}

// Under a mirror ring in slanting light, where the nephroid has run out into a wider patch; within the
// bounding sphere, where cells that straddle the edge of the disc count.
TEST_P(IrradianceVolumeAs, KeepsTheFluxOfARing) {
  const Mesh ring = makeRing(0.5f, 0.25f, 0.02f, {.vertices = 6000});
  IrradianceVolume volume(ring, silver_, settings(900, 60), {});
  // One of the sampled directions, so that nothing is interpolated.
  const vec3 light = volume.lightSamples().directions()[1];
  const vec3 down(0, light.y < 0 ? -1 : 1, 0);
  const double flux =
      photonsThrough(CasterTracer(ring, silver_, Paths::transmission), light, 0.3f * down, down);
  EXPECT_NEAR(fluxThrough(volume, light, 0.3f * down, down) / flux, 1, 0.05);
}

// Away from the ball's focus, by rings around the axis, against the closed form.
TEST_P(IrradianceVolumeAs, ShowsABallsLightWhereItFalls) {
  IrradianceVolume volume(ball, glass(), settings(360, 100), {});
  constexpr std::size_t kRings = 8;
  constexpr double kWidth = 0.05, kHeight = 1.1;
  const std::vector<double> rings = ballLensRings(0.5, kHeight, 1.5, kWidth, kRings);
  double error = 0, sum = 0;
  for (std::size_t i = 0; i < kRings; ++i) {
    constexpr int kPoints = 64;
    double lux = 0;
    for (int k = 0; k < kPoints; ++k) {
      const double r = (double(i) + (k + 0.5) / kPoints) * kWidth, angle = 2.4 * k;
      const vec3 point(float(r * std::cos(angle)), float(-kHeight), float(r * std::sin(angle)));
      lux += double(volume.illuminance(point, vec3(0, 1, 0), vec3(0, -1, 0), LightInterpolation::rotated).y) *
             2 * r * kWidth / kPoints;
    }
    const double inner = double(i) * kWidth, outer = inner + kWidth;
    const double area = outer * outer - inner * inner;  // over pi
    const double difference = (lux - rings[i] / std::numbers::pi) / area;
    error += difference * difference * area;
    sum += std::pow(rings[i] / std::numbers::pi / area, 2) * area;
  }
  EXPECT_LT(std::sqrt(error / sum), 0.1);
}

std::string nameOf(const testing::TestParamInfo<uint32_t>& test) {
  constexpr const char* kNames[] = {"Grid", "Shells", "MultiResolution"};
  return kNames[test.param];
}

INSTANTIATE_TEST_SUITE_P(Representations, IrradianceVolumeAs,
                         testing::Values(kRepresentationGrid, kRepresentationShells,
                                         kRepresentationMultiResolution),
                         nameOf);

// Of a finest grid, at a part of its size.
TEST(IrradianceVolume, TakesLessWhereLessIsNeeded) {
  const Mesh ball = makeSphere(0.5f, {.vertices = 6000});
  VolumeSettings settings = someSettings();
  settings.kilobytes = 1440;
  settings.representation = kRepresentationMultiResolution;
  std::size_t before = 1440000;
  for (const uint32_t error : {5u, 20u, 100u}) {
    settings.error = error;
    const std::size_t bytes = IrradianceVolume(ball, glass(), settings, {}).sample(0).words.size_bytes();
    EXPECT_LT(bytes, before);
    before = bytes;
  }
  EXPECT_LT(before, 300000u);
}

TEST(SphericalHarmonics, AreOrthonormal) {
  const LightSphere sphere(4);
  constexpr uint32_t kOrder = 6, kCount = (kOrder + 1) * (kOrder + 1);
  std::vector<double> products(kCount * kCount, 0);
  double solidAngle = 0;
  for (const uvec3& t : sphere.triangles()) {
    const vec3 a = sphere.directions()[t.x], b = sphere.directions()[t.y], c = sphere.directions()[t.z];
    const double area = double(length(cross(b - a, c - a))) / 2;
    const std::vector<float> values = sphericalHarmonics(kOrder, normalize(a + b + c));
    for (uint32_t i = 0; i < kCount; ++i)
      for (uint32_t j = 0; j < kCount; ++j) products[i * kCount + j] += area * double(values[i] * values[j]);
    solidAngle += area;
  }
  for (uint32_t i = 0; i < kCount; ++i)
    for (uint32_t j = 0; j < kCount; ++j)
      EXPECT_NEAR(products[i * kCount + j] * 4 * std::numbers::pi / solidAngle, i == j ? 1 : 0, 0.01);
}

// Blurred over light directions, a ball's light still crosses the plane behind it.
TEST(IrradianceVolume, KeepsTheFluxOfABallInSphericalHarmonics) {
  const Mesh ball = makeSphere(0.5f, {.vertices = 3000});
  VolumeSettings settings = someSettings();
  settings.lightLevel = 2;
  settings.representation = kRepresentationHarmonics;
  const vec3 light = normalize(vec3(0.3f, -1, 0.2f));
  double before = 0;
  for (const uint32_t order : {2u, 5u}) {
    settings.order = order;
    settings.kilobytes = 20;
    IrradianceVolume volume(ball, glass(), settings, {});
    EXPECT_EQ(volume.sampleCount(), (order + 1) * (order + 1));
    // More of the light is on the disc, rather than spread around the ball, the higher the order.
    const double part =
        fluxThrough(volume, light, 0.8f * light, light) / ballLensRings(0.5, 0.8, 1.5, 0.5, 1)[0];
    EXPECT_GT(part, before);
    EXPECT_LT(part, 1.05);
    before = part;
  }
  EXPECT_GT(before, 0.8);
}

// Root mean square difference, on a square behind the caster, of light looked up between samples to that of
// a sample of its own.
double errorBetweenSamples(IrradianceVolume& volume, const CasterTracer& tracer, vec3 light,
                           LightInterpolation interpolation) {
  constexpr int kPoints = 48;
  constexpr float kDistance = 1.8f, kHalf = 1.5f;  // bounding radii
  const mat3 frame = sampleFrame(light);
  const VolumeSample truth = gridSample(tracer.trace(frame, 60000, 3.2f), 360000);
  double squares = 0, sum = 0;
  for (int y = 0; y < kPoints; ++y)
    for (int x = 0; x < kPoints; ++x) {
      const vec2 across = kHalf * ((vec2(float(x), float(y)) + 0.5f) * (2.0f / kPoints) - 1.0f);
      const vec3 place(across, kDistance);
      const double expected = double(
          surfaceIlluminance(lightAt(truth.layout, truth.words, kRepresentationGrid, place), vec3(0, 0, -1))
              .y);
      const vec3 point = tracer.sphere().center + tracer.sphere().radius * (frame * place);
      const double lux = double(volume.illuminance(point, -light, light, interpolation).y);
      squares += (lux - expected) * (lux - expected);
      sum += expected * expected;
    }
  return std::sqrt(squares / sum);
}

// Half-way between two samples: a prism's light neither stays nor turns with the lamp, a ring's nephroid
// stretches.
TEST(IrradianceVolume, FlowsBetweenSamples) {
  struct Case {
    Mesh mesh;
    Material material;
  };
  VolumeSettings settings = someSettings();
  settings.kilobytes = 360;
  settings.lightLevel = 3;
  settings.photons = 60;
  for (const Case& item : {Case{makePrism(0.5f, 1), glass()},
                           Case{makeRing(0.5f, 0.25f, 0.02f, {.vertices = 2000}), silver()}}) {
    const CasterTracer tracer(item.mesh, item.material, Paths::transmission);
    IrradianceVolume volume(item.mesh, item.material, settings, {});
    const std::vector<vec3>& directions = volume.lightSamples().directions();
    const auto distance = [&](vec3 to) { return [to](vec3 d) { return length(d - to); }; };
    const vec3 one = *std::ranges::min_element(directions, {}, distance(normalize(vec3(0.6f, 0.8f, 0.1f))));
    const vec3 other =
        *std::ranges::min_element(directions, {}, [&](vec3 d) { return d == one ? 10.0f : length(d - one); });
    const vec3 light = normalize(one + other);
    const auto error = [&](LightInterpolation interpolation) {
      return errorBetweenSamples(volume, tracer, light, interpolation);
    };
    const double flow = error(LightInterpolation::flow);
    EXPECT_LT(flow, 0.5 * error(LightInterpolation::nearest));
    EXPECT_LT(flow, 0.5 * error(LightInterpolation::barycentric));
    EXPECT_LT(flow, 0.8 * error(LightInterpolation::rotated));
  }
}

// What light does beyond its region is what it would in a larger one.
TEST(IrradianceVolume, GoesOnBeyondItsRegion) {
  const Mesh ball = makeSphere(0.5f, {.vertices = 6000});
  IrradianceVolume volume(ball, glass(), someSettings(), {});
  const vec3 light = normalize(vec3(0.3f, -1, 0.2f));
  for (const float distance : {1.6f, 2.5f, 4.0f}) {
    const double flux = ballLensRings(0.5, double(distance), 1.5, double(distance), 1)[0];
    EXPECT_NEAR(fluxThrough(volume, light, distance * light, light, distance) / flux, 1, 0.03) << distance;
  }
}

// What a body of revolution sends on turns with the light.
// Light that nothing bends, as it comes from afar, made that of a lamp: it comes from there, is as strong on
// its axis as the square of the distance has it, and crosses a window as it crosses the window's image.
TEST(NearLight, ComesFromItsLampWithAllItsFlux) {
  const vec3 lamp(0.4f, 1.5f, -0.3f), nearness = lamp / dot(lamp, lamp), along = -normalize(lamp);
  const auto light = [&](vec3 x) { return nearVector(along, x, nearness); };
  for (const vec3 x : {vec3(0.2f, -0.7f, 0.1f), vec3(-0.5f, 0.3f, 0.6f)})
    EXPECT_NEAR(dot(normalize(light(x)), normalize(x - lamp)), 1, 1e-6f);
  for (const float way : {-0.8f, 0.5f, 2.0f})
    EXPECT_NEAR(length(light(way * along)), dot(lamp, lamp) / std::pow(length(lamp) + way, 2.0f), 1e-5f);
  const vec3 corner(-0.4f, -1, 0.2f), u(0.9f, 0.2f, 0.1f), v(0.1f, -0.3f, 0.7f);
  constexpr int kSteps = 200;
  double flux = 0;
  for (int i = 0; i < kSteps * kSteps; ++i) {
    const vec2 at = (vec2(float(i % kSteps), float(i / kSteps)) + 0.5f) / float(kSteps);
    flux += double(dot(light(corner + at.x * u + at.y * v), cross(u, v))) / (kSteps * kSteps);
  }
  const auto image = [&](vec3 x) { return nearScale(x, nearness) * x; };
  const vec3 a = image(corner), b = image(corner + u), c = image(corner + u + v), d = image(corner + v);
  EXPECT_NEAR(flux, double(dot(along, 0.5f * (cross(b - a, c - a) + cross(c - a, d - a)))), 1e-4);
  EXPECT_EQ(nearScale(1.1f * lamp, nearness), 0);
  EXPECT_EQ(nearVector(along, vec3(1, 2, 3), vec3(0)), along);
}

TEST(IrradianceVolume, TurnsWithTheLightAboutAnAxis) {
  const Mesh mesh = makeRing(0.5f, 0.3f, 0.05f, {.vertices = 4000});
  IrradianceVolume volume(mesh, silver(), someSettings(), {});
  const vec3 light = normalize(vec3(0.8f, -0.6f, 0));
  const mat3 turn = glm::mat3_cast(glm::angleAxis(2.0f, vec3(0, 1, 0)));
  for (const vec3 point : {vec3(0.2f, -0.14f, 0.1f), vec3(-0.3f, -0.1f, 0), vec3(-0.8f, -0.5f, 0.2f)}) {
    const vec3 up(0, 1, 0);
    const vec3 lux = volume.illuminance(point, up, light, LightInterpolation::rotated);
    const vec3 there = volume.illuminance(turn * point, up, turn * light, LightInterpolation::rotated);
    EXPECT_LT(length(lux - there), 5e-3f * (length(lux) + 0.1f));
    if (lux.x > 0.01f) {
      EXPECT_NEAR(lux.z / lux.x, 0.6f / 0.9f, 0.02f);
    }
  }
}

TEST(IrradianceVolume, DoesNotDependOnTheNumberOfThreads) {
  const Mesh mesh = makePrism(0.5f, 1);
  const auto wordsOf = [&] {
    const SampleView sample = IrradianceVolume(mesh, glass(), someSettings(), {}).makeSample(3);
    return std::vector<uint32_t>(sample.words.begin(), sample.words.end());
  };
  const std::vector<uint32_t> many = wordsOf();
  const oneapi::tbb::global_control one(oneapi::tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(many, wordsOf());
}

// Of the mean over the cells that hold little light, where noise is seen, against `truth`.
double noiseOf(std::span<const CellSum> cells, std::span<const CellSum> truth) {
  double mean = 0, squares = 0, lit = 0, sum = 0;
  for (const CellSum& cell : truth) mean += double(cell.vector.z) / double(truth.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    const double value(truth[i].vector.z);
    if (value <= 0 || value > 4 * mean) continue;
    squares += std::pow(double(cells[i].vector.z) - value, 2);
    sum += value;
    ++lit;
  }
  return std::sqrt(squares / lit) / (sum / lit);
}

// No light is blurred to be rid of noise: photons that are spread evenly have less of it. Four times as many
// random ones would have half the noise, even ones a quarter at best: nearer to that.
TEST(Photons, LeaveLessNoiseThanRandomOnes) {
  const Mesh ball = makeSphere(0.5f, {.vertices = 6000});
  const Material material = glass();
  const CasterTracer tracer(ball, material, Paths::transmission);
  const auto traced = [&](uint32_t photons) { return tracer.trace({0, 0, 1}, photons, 3); };
  const std::vector<PhotonPath> many = traced(800000);
  const SampleLayout layout = gridAround(litBox(many), 8000);
  const std::vector<CellSum> truth = gridSums(many, layout);
  const double few = noiseOf(gridSums(traced(12500), layout), truth);
  const double more = noiseOf(gridSums(traced(50000), layout), truth);
  EXPECT_LT(more, 0.375 * few);
}

}  // namespace
}  // namespace nephroid
