// Flux that the reference renderer sends through glass and over mirrors, against closed forms.
#include <gtest/gtest.h>

#include <map>

#include "support/closed_forms.h"
#include "support/reference_scenes.h"
#include "support/statistics.h"

namespace nephroid {
namespace {

constexpr double kLux = 1000;

// One number a channel, with what it may be off by.
struct Measured {
  glm::dvec3 lux;
  glm::dvec3 standardError;
};

Measured causticsOn(const Scene& scene, Sensor sensor, Paths paths, uint32_t photons = 1 << 14) {
  sensor.resolution = {1, 1};
  ReferenceSettings settings;
  settings.paths = paths;
  settings.photons = photonsOf(photons);
  const Image image = measured(scene, sensor, 32, settings);
  Measured result{};
  for (int c = 0; c < 3; ++c) {
    const std::string channel(1, "RGB"[c]);
    result.lux[c] = double(image.find("caustics." + channel)->at(0));
    result.standardError[c] = double(image.find("caustics.standard_error." + channel)->at(0));
  }
  return result;
}

void expectLux(const Measured& measured, glm::dvec3 expected) {
  for (int c = 0; c < 3; ++c) {
    const double error = std::abs(measured.lux[c] - expected[c]);
    // An eighth of a hundred thousandth: photons' flux in single precision.
    EXPECT_LT(error, 4 * measured.standardError[c] + 1e-5 * expected[c])
        << measured.lux[c] << ", not " << expected[c] << " in channel " << c;
    // So few photons would show nothing.
    EXPECT_LT(measured.standardError[c], standardErrorOf(0.01) * expected[c]);
  }
}

vec3 sunAt(double degreesFromVertical) {
  const double angle = glm::radians(degreesFromVertical);
  return {std::sin(angle), -std::cos(angle), 0};
}

// A pane of 0.2 m over a sensor of half a meter.
Scene pane(const Material& material, double degreesFromVertical) {
  Scene scene;
  add(scene, makeBox({2.2f, 0.2f, 2.2f}), material);
  scene.lights = {sun(sunAt(degreesFromVertical), float(kLux))};
  return scene;
}

const Sensor kUnderThePane = floorSensor({0, -0.2f, 0}, 0.25f, 1);

TEST(FlatWater, KeepsTheCosineAndTheTransmittance) {
  for (const double degrees : {0.0, 30.0, 60.0}) {
    Scene scene;
    Water water;
    water.size = {4, 4};
    water.grid = {16, 16};
    Material material = glass(1.33f);
    material.attenuationColor = {0.5f, 0.8f, 0.9f};
    material.attenuationDistance = 1;
    add(scene, makeWater(water, 0), material);
    scene.lights = {sun(sunAt(degrees), float(kLux))};
    const double cosine = std::cos(glm::radians(degrees));
    const double length = 0.7 / std::sqrt(1 - std::pow(std::sin(glm::radians(degrees)) / 1.33, 2));
    const glm::dvec3 left = glm::pow(glm::dvec3(material.attenuationColor), glm::dvec3(length));
    const glm::dvec3 expected = kLux * cosine * (1 - fresnel(cosine, 1 / 1.33)) * left;
    for (const Paths paths : {Paths::transmission, Paths::all})
      expectLux(causticsOn(scene, floorSensor({0, -0.7f, 0}, 0.4f, 1), paths), expected);
  }
}

TEST(ParallelPlate, LetsThroughWhatItsFacesDo) {
  for (const double degrees : {0.0, 45.0, 70.0}) {
    const Scene scene = pane(glass(), degrees);
    const double cosine = std::cos(glm::radians(degrees));
    const double face = fresnel(cosine, 1 / 1.5);
    expectLux(causticsOn(scene, kUnderThePane, Paths::transmission),
              glm::dvec3(kLux * cosine * (1 - face) * (1 - face)));
    // All reflections between its faces: the sum of a geometric series.
    expectLux(causticsOn(scene, kUnderThePane, Paths::all),
              glm::dvec3(kLux * cosine * (1 - face) / (1 + face)));
  }
}

TEST(ParallelPlate, OfTintedGlassFollowsBeerAndLambert) {
  Material tinted = glass();
  tinted.attenuationColor = {0.2f, 0.6f, 0.95f};
  tinted.attenuationDistance = 0.1f;
  const Scene scene = pane(tinted, 40);
  const double cosine = std::cos(glm::radians(40.0)), face = fresnel(cosine, 1 / 1.5);
  const double length = 0.2 / std::sqrt(1 - std::pow(std::sin(glm::radians(40.0)) / 1.5, 2));
  const glm::dvec3 left = glm::pow(glm::dvec3(tinted.attenuationColor), glm::dvec3(length / 0.1));
  const glm::dvec3 twoFaces = kLux * cosine * (1 - face) * (1 - face) * left;
  expectLux(causticsOn(scene, kUnderThePane, Paths::transmission), twoFaces);
  expectLux(causticsOn(scene, kUnderThePane, Paths::all), twoFaces / (1.0 - face * face * left * left));
}

TEST(ThinWall, LetsThroughWhatBothFacesDo) {
  Material sheet = glass();
  sheet.thinWalled = true;
  sheet.color = {0.9f, 0.5f, 0.1f};
  Scene scene;
  add(scene, makePlane({3, 3}), sheet);
  scene.lights = {sun(sunAt(60), float(kLux))};
  const double face = fresnel(0.5, 1 / 1.5);
  for (const Paths paths : {Paths::transmission, Paths::all})
    expectLux(causticsOn(scene, kUnderThePane, paths),
              kLux * 0.5 * (1 - face) / (1 + face) * glm::dvec3(sheet.color));
}

// Lumens by place on the floor, pass by pass.
class FloorProfile {
 public:
  using BinOf = std::function<std::size_t(vec3)>;  // as many as there are bins: outside

  FloorProfile(const Scene& scene, uint32_t floor, std::size_t bins, const BinOf& binOfPlace, Paths paths)
      : means(bins) {
    const RayScene rays(scene);
    const Boundaries boundaries(scene, rays);
    const Lights lights(scene, Aim::casters);
    const PhotonTracer tracer(scene, boundaries, lights, paths);
    for (uint32_t pass = 0; pass < kPasses; ++pass) {
      FluxLedger ledger;
      std::vector<double> flux(bins + 1, 0.0);
      const PhotonPass ofPass = photonPass(scene, Spectrum::channels, 1, pass, 1 << 14);
      for (const Visitor& group : tracePass(tracer, ofPass, Visitor(floor), ledger))
        for (const auto& [place, lumens] : group.landings) flux[binOfPlace(place)] += double(lumens.y);
      for (std::size_t bin = 0; bin < bins; ++bin) means[bin].add(flux[bin]);
    }
  }

  // Those bins aside in which hardly any photon ever lands.
  void expectFlux(const std::vector<double>& expected) const {
    ASSERT_EQ(expected.size(), means.size());
    double chiSquare = 0, degrees = 0, sum = 0;
    for (std::size_t bin = 0; bin < means.size(); ++bin) {
      const double error = means[bin].standardError();
      const double difference = means[bin].mean() - expected[bin];
      sum += expected[bin];
      if (means[bin].mean() < 10 * error || error == 0) continue;
      chiSquare += difference * difference / (error * error);
      ++degrees;
    }
    EXPECT_GT(degrees, 10);
    // The spread is itself known from so few passes: Student's variance.
    EXPECT_LT(chiSquare * (kPasses - 3.0) / (kPasses - 1.0), chiSquareLimit(degrees))
        << "of " << degrees << " degrees of freedom, " << sum << " lm";
  }
  double flux(std::size_t bin) const { return means[bin].mean(); }

 private:
  static constexpr uint32_t kPasses = 32;
  struct Visitor final : PhotonVisitor {
    explicit Visitor(uint32_t floor) : object(floor) {}
    void landing(const PhotonSegment&, const Hit& hit, vec3 flux) override {
      if (hit.object == object) landings.emplace_back(hit.flatPosition, flux);
    }
    uint32_t object;
    std::vector<std::pair<vec3, vec3>> landings;
  };
  std::vector<SampleMean> means;
};

TEST(ParallelPlate, ShiftsABeamAsSnellSays) {
  // A spot of 4 degrees, tilted by 45, through a pane of 0.5 m.
  Scene scene;
  scene.lights = {spotLight({-2, 2, 0}, vec3(0), 2, 5)};
  add(scene, makeBox({4, 0.5f, 4}), glass(), {0, 0.5f, 0});
  add(scene, makePlane({8, 8}), diffuse(0.5f));
  constexpr std::size_t kColumns = 40;
  const auto columnOf = [](double x) {
    const double place = (x + 1) / 2 * double(kColumns);
    return place >= 0 && place < double(kColumns) ? std::size_t(place) : kColumns;
  };
  const FloorProfile profile(
      scene, 1, kColumns, [&](vec3 p) { return columnOf(double(p.x)); }, Paths::transmission);

  // Ray by ray: in the air it falls 1.5 m in all, in the glass half a meter.
  std::vector<double> expected(kColumns + 1, 0.0);
  constexpr int kRings = 1500, kSectors = 720;
  const Light& light = scene.lights[0];
  const mat3 frame = frameAround(light.direction);
  const double width = 1 - std::cos(glm::radians(5.0)), inner = std::cos(glm::radians(2.0));
  for (int ring = 0; ring < kRings; ++ring)
    for (int sector = 0; sector < kSectors; ++sector) {
      const double drop = width * (ring + 0.5) / kRings, turn = 2 * double(kPi) * (sector + 0.5) / kSectors;
      const double aside = std::sqrt(drop * (2 - drop));
      const glm::dvec3 d =
          glm::dmat3(frame) * glm::dvec3(aside * std::cos(turn), aside * std::sin(turn), 1 - drop);
      const double cosine = -d.y, sine = std::sqrt(1 - cosine * cosine);
      const double inGlass = sine / 1.5;
      const double across = 1.5 * sine / cosine + 0.5 * inGlass / std::sqrt(1 - inGlass * inGlass);
      const double cosFromAxis = 1 - drop;
      const double falloff = std::min(1.0, (cosFromAxis - (1 - width)) / (inner - (1 - width)));
      const double transmitted = 1 - fresnel(cosine, 1 / 1.5);
      expected[columnOf(-2 + across * d.x / sine)] +=
          100 * falloff * falloff * 2 * double(kPi) * width / (kRings * kSectors) * transmitted * transmitted;
    }
  expected.pop_back();
  profile.expectFlux(expected);
}

TEST(BallLens, MatchesTheClosedFormBeforeInAndPastTheFocus) {
  for (const float height : {0.6f, 0.75f, 1.2f}) {
    SCOPED_TRACE(height);
    Scene scene;
    scene.lights = {sun({0, -1, 0}, float(kLux))};
    add(scene, makeSphere(0.5f, {.vertices = 25600}), glass(), {0, height, 0});
    add(scene, makePlane({8, 8}), diffuse(0.5f));
    constexpr std::size_t kRings = 32;
    const double width = 0.4 / kRings;
    const FloorProfile profile(
        scene, 1, kRings,
        [&](vec3 p) { return std::min(std::size_t(std::hypot(double(p.x), double(p.z)) / width), kRings); },
        Paths::transmission);
    std::vector<double> expected = ballLensRings(0.5, double(height), 1.5, width, kRings);
    for (double& lumens : expected) lumens *= kLux;
    profile.expectFlux(expected);
  }
}

// A mirror ring of half a meter on the floor, the sun at 30 degrees.
Scene mirrorRing() {
  Scene scene;
  const double elevation = glm::radians(30.0);
  scene.lights = {sun({std::cos(elevation), -std::sin(elevation), 0}, float(kLux))};
  add(scene, makeRing(0.5f, 0.2f, 0.01f, {.segments = 1024}), mirror(0.9f), {0, 0.1f, 0});
  add(scene, makePlane({8, 8}), diffuse(0.5f));
  return scene;
}

TEST(MirrorRing, MatchesTheClosedForm) {
  constexpr std::size_t kParts = 16;
  const auto partOf = [](double x, double z) {
    if (std::hypot(x, z) >= 0.5) return kParts * kParts;
    return std::size_t((z + 0.5) * kParts) * kParts + std::size_t((x + 0.5) * kParts);
  };
  const FloorProfile profile(
      mirrorRing(), 1, kParts * kParts, [&](vec3 p) { return partOf(double(p.x), double(p.z)); }, Paths::all);
  std::vector<double> expected(kParts * kParts + 1, 0.0);
  followMirrorRing(0.5, 0.2, glm::radians(30.0), 0.9,
                   [&](double x, double z, double lumens) { expected[partOf(x, z)] += kLux * lumens; });
  expected.pop_back();
  profile.expectFlux(expected);
}

TEST(MirrorRing, HasTheCuspOfTheNephroidAtHalfItsRadius) {
  constexpr std::size_t kParts = 50;  // of a centimeter, along the axis
  const auto partOf = [](double x, double z) {
    return x >= 0 && x < 0.5 && std::abs(z) < 0.002 ? std::size_t(x * 100) : kParts;
  };
  const FloorProfile profile(
      mirrorRing(), 1, kParts, [&](vec3 p) { return partOf(double(p.x), double(p.z)); }, Paths::all);
  std::size_t brightest = 0;
  for (std::size_t part = 0; part < kParts; ++part)
    if (profile.flux(part) > profile.flux(brightest)) brightest = part;
  // From the cusp on, where the strip is as wide as the nephroid.
  EXPECT_EQ(brightest, 25u);
}

}  // namespace
}  // namespace nephroid
