// Every sampler against the distribution it stands for.
#include <gtest/gtest.h>

#include <limits>

#include "optics/phase.h"
#include "optics/refraction.h"
#include "support/reference_scenes.h"
#include "support/statistics.h"

namespace nephroid {
namespace {

constexpr double kTurn = 2 * double(kPi);
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr int kSamples = 1 << 17;

vec2 uniformPair(Random& random) {
  const float first = random.uniform();
  return {first, random.uniform()};
}

double turnOf(double x, double y) {
  const double turn = std::atan2(y, x) / kTurn;
  return turn < 0 ? turn + 1 : turn;
}

TEST(Sampling, OfAConeIsUniformInSolidAngle) {
  for (const float width : {1e-6f, 0.01f, 0.4f, 1.0f, 2.0f}) {
    SCOPED_TRACE(width);
    Random random(1);
    WeightedHistogram parts(16 * 16);
    for (int i = 0; i < kSamples; ++i) {
      const glm::dvec3 d(sampleCone(uniformPair(random), width));
      ASSERT_NEAR(length(d), 1, 1e-6);
      const double sineSquared = d.x * d.x + d.y * d.y;
      const double drop = d.z > 0.5 ? sineSquared / (1 + std::sqrt(1 - sineSquared)) : 1 - d.z;
      parts.add(binOf(drop / double(width), 16) * 16 + binOf(turnOf(d.x, d.y), 16));
    }
    parts.expectUniform();
    EXPECT_NEAR(double(coneDensity(width)) * kTurn * double(width), 1, 1e-6);
  }
}

TEST(Sampling, OfADiscIsUniformInArea) {
  Random random(2);
  WeightedHistogram parts(16 * 16);
  for (int i = 0; i < kSamples; ++i) {
    const glm::dvec2 p(sampleDisk(uniformPair(random)));
    parts.add(binOf(dot(p, p), 16) * 16 + binOf(turnOf(p.x, p.y), 16));
  }
  parts.expectUniform();
}

TEST(Sampling, FramesStandOnTheirAxis) {
  Random random(3);
  for (int i = 0; i < 1000; ++i) {
    const vec3 axis = i < 2 ? vec3(0, 0, i ? -1 : 1) : sampleCone(uniformPair(random), 2);
    const mat3 frame = frameAround(axis);
    const mat3 product = transpose(frame) * frame;
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) ASSERT_NEAR(product[column][row], row == column, 1e-6) << i;
    ASSERT_NEAR(determinant(frame), 1, 1e-6);
  }
}

TEST(Sampling, OfDistancesFallsAsTheLightDoes) {
  struct Case {
    float extinction, length;
  };
  for (const auto& [extinction, length] :
       {Case{0.5f, 4}, Case{0.5f, kInfinity}, Case{3, 100}, Case{1e-3f, 1}, Case{1e-6f, 2}, Case{0, 2}}) {
    SCOPED_TRACE(testing::Message() << extinction << " per meter along " << length);
    Random random(4);
    WeightedHistogram parts(64);
    const double sigma(extinction), end(length);
    const double whole = -std::expm1(-sigma * end);  // scattered on all the way
    for (int i = 0; i < kSamples; ++i) {
      const DistanceSample sample = sampleExtinction(random.uniform(), extinction, length);
      const double distance(sample.distance);
      const double before = sigma > 0 ? -std::expm1(-sigma * distance) / whole : distance / end;
      parts.add(binOf(before, 64));
      const double density = sigma > 0 ? sigma * std::exp(-sigma * distance) / whole : 1 / end;
      // Two places of single precision, and the depth below which a density is taken for even.
      ASSERT_NEAR(double(sample.density), density, 1e-4 * density);
    }
    parts.expectUniform();
  }
}

TEST(Sampling, OfDistancesIsEvenInTheAngleSeenFromALight) {
  struct Case {
    vec3 light;
    float length;
  };
  // Beside the ray, behind it, beyond its end, close to it, on it, far behind it and nearly on its line.
  for (const auto& [light, length] : {Case{{1, 0, 2}, 5}, Case{{0.3f, 0.4f, -3}, 4}, Case{{0, 2, 9}, 3},
                                      Case{{0, 1e-3f, 2}, 5}, Case{{0, 0, 8}, 5}, Case{{1, 1, 3}, kInfinity},
                                      Case{{1, 0, -3}, kInfinity}, Case{{0.01f, 0, -100}, 1}}) {
    SCOPED_TRACE(testing::Message() << light.x << ' ' << light.y << ' ' << light.z << ", " << length);
    Random random(5);
    WeightedHistogram parts(64);
    const double nearest(light.z);
    const double height = std::max(std::hypot(double(light.x), double(light.y)), 1e-6);
    const double first = std::atan2(-nearest, height), last = std::atan2(double(length) - nearest, height);
    for (int i = 0; i < kSamples; ++i) {
      const DistanceSample sample =
          sampleEquiangular(random.uniform(), vec3(0), vec3(0, 0, 1), length, light);
      const double offset = double(sample.distance) - nearest;
      parts.add(binOf((std::atan2(offset, height) - first) / (last - first), 64));
      const double density = height / ((last - first) * (height * height + offset * offset));
      // Distances are rounded to 1e-6 of those to the light.
      const double rounding = 1e-6 * std::abs(nearest) / std::max(std::abs(offset), height);
      ASSERT_NEAR(double(sample.density), density, (1e-4 + 4 * rounding) * density);
    }
    parts.expectUniform();
  }
}

TEST(Sampling, OfACurveIsUniformInTheSquare) {
  Random random(6);
  WeightedHistogram parts(16 * 16);
  for (int i = 0; i < kSamples; ++i) {
    const vec2 point = pointOnCurve(double(random.uniform()) + double(random.uniform()) * 0x1p-24);
    parts.add(binOf(double(point.x), 16) * 16 + binOf(double(point.y), 16));
  }
  parts.expectUniform();
  // Even numbers are even in the square: one in each of so many parts.
  std::vector<int> counts(256 * 256, 0);
  for (int i = 0; i < 256 * 256; ++i) {
    const uvec2 part(pointOnCurve((double(i) + double(random.uniform())) / (256 * 256)) * 256.0f);
    ++counts.at(part.y * 256 + part.x);
  }
  for (const int count : counts) ASSERT_EQ(count, 1);
}

TEST(Sampling, ItemsOfPassesHaveNumbersOfTheirOwn) {
  WeightedHistogram parts(16 * 16);
  for (uint64_t seed = 0; seed < 16; ++seed)
    for (uint64_t pass = 0; pass < 16; ++pass)
      for (uint64_t item = 0; item < 512; ++item) {
        Random here = randomOf(seed, pass, item), next = randomOf(seed, pass, item + 1);
        parts.add(binOf(double(here.uniform()), 16) * 16 + binOf(double(next.uniform()), 16));
      }
  parts.expectUniform();
}

TEST(Spectrum, WavelengthsAreAsLikelyAsTheirDensity) {
  constexpr int kWide = 7;  // nm
  std::vector<double> expected(50, 0.0);
  double total = 0;
  for (int i = 0; i < 350; ++i) {
    const double density = double(wavelengthDensity(kShortestWavelength + float(i) + 0.5f));
    expected[std::size_t(i / kWide)] += density;
    total += density;
  }
  EXPECT_NEAR(total, 1, 1e-5);
  Random random(7);
  WeightedHistogram parts(50);
  for (int i = 0; i < 1 << 20; ++i) {
    const double wavelength = double(sampleWavelength(random.uniform()));
    parts.add(binOf((wavelength - 380) / 350, 50));
  }
  parts.expectMeans(expected);
  EXPECT_EQ(sampleWavelength(0), kShortestWavelength);
  EXPECT_LE(sampleWavelength(0x1.fffffep-1f), kLongestWavelength);
}

TEST(Spectrum, TheMeanOfAllWavelengthsIsWhite) {
  glm::dvec3 mean(0);
  for (int i = 0; i < 350; ++i) {
    const float wavelength = kShortestWavelength + float(i) + 0.5f;
    const glm::dvec3 weight(wavelengthWeight(wavelength));
    EXPECT_GE(std::min({weight.x, weight.y, weight.z}), 0);
    mean += weight * double(wavelengthDensity(wavelength));
  }
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(mean[c], 1, 1e-5);
}

TEST(Spectrum, TheBandsOfAPassAreWhiteOnAverage) {
  Scene scene;
  Material dispersive = glass();
  dispersive.ior = {1.49f, 1.5f, 1.52f};
  add(scene, makeSphere(1, {.vertices = 12}), dispersive);
  Random random(8);
  SampleMean channels[3];
  for (int pass = 0; pass < 4000; ++pass) {
    vec3 mean(0);
    const std::vector<Band> bands = chooseBands(scene, Spectrum::continuous, random);
    for (const Band& band : bands) mean += band.weight / float(bands.size());
    for (int c = 0; c < 3; ++c) channels[c].add(double(mean[c]));
  }
  for (const SampleMean& channel : channels)
    EXPECT_LT(std::abs(channel.mean() - 1), 4 * channel.standardError()) << channel.mean();
  vec3 ofChannels(0);
  for (const Band& band : chooseBands(scene, Spectrum::channels, random)) ofChannels += band.weight / 3.0f;
  EXPECT_EQ(ofChannels, vec3(1));
}

Band at(float wavelength) {
  Band band;
  band.wavelength = wavelength;
  return band;
}

TEST(Spectrum, AnIndexPerChannelIsMetAtTheChannelsWavelengths) {
  Material material = glass();
  material.ior = {1.50f, 1.52f, 1.56f};
  EXPECT_NEAR(indexOfRefraction(material, at(611)), 1.50f, 1e-6);
  EXPECT_NEAR(indexOfRefraction(material, at(549)), 1.52f, 1e-6);
  EXPECT_NEAR(indexOfRefraction(material, at(464)), 1.56f, 1e-6);
  // Linear in the inverse square of the wavelength between them: 500 nm by the line through the upper two.
  const double share = (1 / (500.0 * 500) - 1 / (549.0 * 549)) / (1 / (464.0 * 464) - 1 / (549.0 * 549));
  EXPECT_NEAR(indexOfRefraction(material, at(500)), 1.52 + 0.04 * share, 1e-6);
  for (float wavelength = kShortestWavelength; wavelength < kLongestWavelength; ++wavelength)
    EXPECT_GT(indexOfRefraction(material, at(wavelength)), indexOfRefraction(material, at(wavelength + 1)));
  EXPECT_EQ(indexOfRefraction(glass(1.3f), at(400)), 1.3f);
  material.ior = {1.01f, 1.005f, 1.3f};
  for (float wavelength = kShortestWavelength; wavelength < kLongestWavelength; ++wavelength)
    EXPECT_GE(indexOfRefraction(material, at(wavelength)), 1);
}

TEST(Spectrum, AnAbbeNumberIsMetByTheLinesThatDefineIt) {
  Material material = glass();
  material.ior = {1.51f, 1.5168f, 1.53f};
  material.dispersion = 20 / 64.17f;  // BK7
  const double d = double(indexOfRefraction(material, at(587.56f)));
  const double spread =
      double(indexOfRefraction(material, at(486.13f))) - double(indexOfRefraction(material, at(656.27f)));
  EXPECT_NEAR(d, 1.5168, 1e-6);
  // Two indices, each rounded to 6e-8.
  EXPECT_NEAR((d - 1) / spread, 64.17, 64.17 * 2.4e-7 / spread);
}

TEST(PhaseFunctions, GiveBackAllThatIsScattered) {
  struct Case {
    uint type;
    double g, meanCosine;
  };
  // Nishita's: the mean of c over 1 + 9 ((1 + c) / 2)^8, half of it by c = 2 t - 1.
  for (const auto& [type, g, meanCosine] :
       {Case{kPhaseIsotropic, 0, 0}, Case{kPhaseHenyeyGreenstein, 0.6, 0.6},
        Case{kPhaseHenyeyGreenstein, -0.3, -0.3}, Case{kPhaseNishita, 0, 9 * (0.1 - 1.0 / 18)}}) {
    constexpr int kSteps = 200000;
    double sum = 0, forward = 0;
    for (int i = 0; i < kSteps; ++i) {
      const double cosine = -1 + 2 * (i + 0.5) / kSteps;
      const double scattered = kTurn * 2 / kSteps * double(phaseFunction(type, float(g), float(cosine)));
      sum += scattered;
      forward += cosine * scattered;
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_NEAR(forward, meanCosine, 1e-5);
  }
}

// Rays at an angle onto the top of a glass box, from outside and from inside.
class SentOn : public testing::Test {
 protected:
  void arrive(float degrees, bool fromInside) {
    const float angle = glm::radians(degrees);
    path.direction = {std::sin(angle), fromInside ? std::cos(angle) : -std::cos(angle), 0};
    const Ray ray{vec3(0, 0.5f, 0) - 0.25f * path.direction, path.direction};
    path.media = boundaries().mediaAround(ray.origin);
    ASSERT_TRUE(rays->intersect(ray, hit));
  }
  void build(const Material& material) {
    scene = {};
    add(scene, makeBox({4, 1, 4}), material);
    rays.emplace(scene);
    built.emplace(scene, *rays);
  }
  Boundaries& boundaries() { return *built; }

  Scene scene;
  std::optional<RayScene> rays;
  std::optional<Boundaries> built;
  Path path;
  Hit hit;
};

TEST_F(SentOn, IsReflectedAsOftenAsFresnelSays) {
  for (const bool fromInside : {false, true})
    for (const float degrees : {0.0f, 30.0f, 40.0f, 60.0f, 80.0f}) {
      build(glass());
      arrive(degrees, fromInside);
      const float eta = fromInside ? 1.5f : 1 / 1.5f;
      const double reflectance = double(fresnelReflectance(std::cos(glm::radians(degrees)), eta));
      Random random(10);
      WeightedHistogram choices(2);
      for (int i = 0; i < kSamples; ++i) {
        Path sent = path;
        ASSERT_TRUE(boundaries().send(hit, Band{}, Carried::flux, Choice::random, random.uniform(), sent));
        const bool isReflected = sent.direction.y * path.direction.y < 0;
        choices.add(isReflected);
        ASSERT_EQ(sent.throughput, vec3(1));  // nothing is split, and flux knows no index
        ASSERT_NEAR(sent.direction.x, path.direction.x * (isReflected ? 1 : eta), 1e-5);
        ASSERT_EQ(sent.media.size, (fromInside == isReflected) ? 1u : 0u);
      }
      choices.expectMeans({1 - reflectance, reflectance});
    }
}

TEST_F(SentOn, CarriesTheSquareOfTheIndexAsRadianceAlone) {
  for (const bool fromInside : {false, true}) {
    build(glass());
    arrive(20, fromInside);
    const double eta = fromInside ? 1.5 : 1 / 1.5;
    const double transmitted = 1 - double(fresnelReflectance(std::cos(glm::radians(20.0f)), float(eta)));
    Path flux = path, radiance = path;
    ASSERT_TRUE(boundaries().send(hit, Band{}, Carried::flux, Choice::transmitted, 0, flux));
    ASSERT_TRUE(boundaries().send(hit, Band{}, Carried::radiance, Choice::transmitted, 0, radiance));
    EXPECT_NEAR(flux.throughput.y, transmitted, 1e-5);
    EXPECT_NEAR(radiance.throughput.y, transmitted * eta * eta, 1e-5);
  }
}

TEST_F(SentOn, ByAThinWallGoesStraightOnOrComesBack) {
  Material pane = glass();
  pane.thinWalled = true;
  pane.color = {0.5f, 1, 0.25f};
  build(pane);
  arrive(50, false);
  const double face = double(fresnelReflectance(std::cos(glm::radians(50.0f)), 1 / 1.5f));
  Random random(12);
  WeightedHistogram choices(2);
  for (int i = 0; i < kSamples; ++i) {
    Path sent = path;
    ASSERT_TRUE(boundaries().send(hit, Band{}, Carried::flux, Choice::random, random.uniform(), sent));
    const bool isReflected = sent.direction.y > 0;
    choices.add(isReflected);
    ASSERT_EQ(sent.throughput, isReflected ? vec3(1) : pane.color);
    ASSERT_NEAR(sent.direction.x, path.direction.x, 1e-6);
  }
  // Reflections between the faces: T = (1 - R) / (1 + R).
  choices.expectMeans({(1 - face) / (1 + face), 2 * face / (1 + face)});
}

TEST(Sampling, OfDistancesStaysFinite) {
  const DistanceSample sample = sampleExtinction(1, 0.1f, std::numeric_limits<float>::infinity());
  EXPECT_TRUE(std::isfinite(sample.distance));
  EXPECT_GT(sample.density, 0);
}

}  // namespace
}  // namespace nephroid
