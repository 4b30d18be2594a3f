// Photons as they set out: as much flux toward every direction and place as the light sends there.
#include <gtest/gtest.h>

#include <functional>

#include "support/reference_scenes.h"
#include "support/statistics.h"

namespace nephroid {
namespace {

constexpr int kPhotons = 1 << 18;
constexpr double kTurn = 2 * double(kPi);
constexpr float kMargin = 1.0001f;  // what is aimed at is that much larger than the caster

Mesh ball(float radius) {
  return makeSphere(radius, {.vertices = 42});
}

// A cone of directions, cut into parts of equal solid angle.
struct ConeParts {
  static constexpr std::size_t kRings = 12, kSectors = 12;
  vec3 axis;
  double width;  // 1 - cosine of the half angle
  mat3 frame = frameAround(axis);

  std::size_t partOf(vec3 direction) const {
    const vec3 local = transpose(frame) * direction;
    double turn = std::atan2(double(local.y), double(local.x)) / kTurn;
    if (turn < 0) turn += 1;
    return binOf((1 - double(local.z)) / width, kRings) * kSectors + binOf(turn, kSectors);
  }

  // Lumens in each part, by quadrature of an intensity (cd).
  std::vector<double> flux(const std::function<double(vec3)>& intensity) const {
    constexpr std::size_t kFine = 40;
    std::vector<double> parts(kRings * kSectors, 0.0);
    const double solidAngle = kTurn * width / double(kRings * kSectors * kFine * kFine);
    for (std::size_t ring = 0; ring < kRings * kFine; ++ring)
      for (std::size_t sector = 0; sector < kSectors * kFine; ++sector) {
        const double drop = width * (double(ring) + 0.5) / double(kRings * kFine);
        const double turn = kTurn * (double(sector) + 0.5) / double(kSectors * kFine);
        const double sine = std::sqrt(drop * (2 - drop));
        const vec3 local(sine * std::cos(turn), sine * std::sin(turn), 1 - drop);
        parts[ring / kFine * kSectors + sector / kFine] += solidAngle * intensity(frame * local);
      }
    return parts;
  }
};

EmittedPhoton emitted(const Lights& lights, Random& random) {
  const double coarse(random.uniform()), fine(random.uniform());
  return lights.emit(coarse + fine * 0x1p-24, random.uniform());
}

void expectFlux(const Scene& scene, Aim aim, const ConeParts& parts,
                const std::function<double(vec3)>& intensity) {
  const Lights lights(scene, aim);
  Random random(1);
  WeightedHistogram flux(ConeParts::kRings * ConeParts::kSectors);
  for (int i = 0; i < kPhotons; ++i) {
    const EmittedPhoton photon = emitted(lights, random);
    ASSERT_EQ(photon.origin, scene.lights[0].position);
    ASSERT_NEAR(length(photon.direction), 1, 1e-6);
    flux.add(parts.partOf(photon.direction), double(photon.flux.x));
  }
  flux.expectMeans(parts.flux(intensity));
}

bool meetsBall(vec3 origin, vec3 direction, vec3 center, float radius) {
  const vec3 offset = center - origin;
  const float along = dot(offset, direction);
  return along > 0 && dot(offset, offset) - along * along < radius * radius;
}

TEST(Emission, OfAPointLightFillsTheConeOfACaster) {
  Scene scene;
  scene.lights = {pointLight({0.5f, 3, 0})};
  add(scene, ball(1), glass());
  const vec3 light = scene.lights[0].position;
  expectFlux(scene, Aim::casters, {normalize(-light), 0.1},
             [&](vec3 direction) { return meetsBall(light, direction, vec3(0), kMargin) ? 100.0 : 0.0; });
}

TEST(Emission, TowardCastersThatOverlapCountsNoDirectionTwice) {
  Scene scene;
  scene.lights = {pointLight({0, 4, 0})};
  struct Ball {
    vec3 center;
    float radius;
  };
  const Ball balls[] = {
      {{-0.5f, 0, 0}, 1}, {{0.7f, 0.3f, 0}, 0.8f}, {{-0.4f, 1, 0.5f}, 0.4f}, {{1.5f, -2, 1}, 2}};
  for (const Ball& b : balls) add(scene, ball(b.radius), glass(), b.center);
  expectFlux(scene, Aim::casters, {{0, -1, 0}, 0.3}, [&](vec3 direction) {
    for (const Ball& b : balls)
      if (meetsBall(scene.lights[0].position, direction, b.center, b.radius * kMargin)) return 100.0;
    return 0.0;
  });
}

TEST(Emission, FromWithinACasterGoesEverywhere) {
  Scene scene;
  scene.lights = {pointLight({0.9f, 0, 0})};
  add(scene, makeTorus(0.9f, 0.3f, {.vertices = 200}), glass());  // the light is inside of its tube
  expectFlux(scene, Aim::casters, {{0, 0, 1}, 2}, [](vec3) { return 100.0; });
}

TEST(Emission, EverywhereIsTheWholeLight) {
  Scene scene;
  scene.lights = {pointLight({5, 1, 2})};
  add(scene, ball(1), diffuse(0.5f));
  expectFlux(scene, Aim::everywhere, {{0, 1, 0}, 2}, [](vec3) { return 100.0; });
}

double spotIntensity(const Light& light, vec3 direction) {
  const double inner = std::cos(glm::radians(double(light.innerAngle)));
  const double outer = std::cos(glm::radians(double(light.outerAngle)));
  const double cosine = dot(glm::dvec3(light.direction), glm::dvec3(direction));
  const double linear = glm::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
  return 100 * linear * linear;
}

TEST(Emission, OfASpotLightFadesTowardItsRim) {
  Scene scene;
  scene.lights = {spotLight({0, 4, 0}, {0.3f, 0, 0}, 10, 25)};
  const Light& light = scene.lights[0];
  add(scene, ball(0.8f), glass());  // seen under less than the cone
  expectFlux(scene, Aim::casters, {light.direction, 0.12}, [&](vec3 direction) {
    return meetsBall(light.position, direction, vec3(0), 0.8f * kMargin) ? spotIntensity(light, direction)
                                                                         : 0;
  });
  scene.meshes[0] = ball(3);  // seen under more
  const auto whole = [&](vec3 direction) { return spotIntensity(light, direction); };
  expectFlux(scene, Aim::casters, {light.direction, 0.12}, whole);
  expectFlux(scene, Aim::everywhere, {light.direction, 0.12}, whole);
}

TEST(Emission, OfTheSunIsEvenOverTheCastersShadows) {
  Scene scene;
  scene.lights = {sun({0.3f, -1, 0.2f})};
  struct Ball {
    vec3 center;
    float radius;
  };
  const Ball balls[] = {{{0, 0, 0}, 1}, {{0.9f, 1, 0}, 0.7f}, {{-1, 3, 0.5f}, 0.5f}};
  for (const Ball& b : balls) add(scene, ball(b.radius), glass(), b.center);
  add(scene, makePlane({20, 20}), diffuse(0.5f), {0, -2, 0});

  constexpr std::size_t kParts = 12, kFine = 40;
  constexpr float kHalfSize = 3;
  const mat3 frame = frameAround(scene.lights[0].direction);
  const auto isMet = [&](vec2 place) {
    for (const Ball& b : balls)
      if (distance(place, vec2(transpose(frame) * b.center)) < b.radius * kMargin) return true;
    return false;
  };
  std::vector<double> expected(kParts * kParts, 0.0);
  const float step = 2 * kHalfSize / float(kParts * kFine);
  for (std::size_t row = 0; row < kParts * kFine; ++row)
    for (std::size_t column = 0; column < kParts * kFine; ++column)
      if (isMet(vec2(float(column) + 0.5f, float(row) + 0.5f) * step - kHalfSize))
        expected[row / kFine * kParts + column / kFine] += 1000 * double(step) * double(step);

  const Lights lights(scene, Aim::casters);
  Random random(2);
  WeightedHistogram flux(kParts * kParts);
  for (int i = 0; i < kPhotons; ++i) {
    const EmittedPhoton photon = emitted(lights, random);
    ASSERT_EQ(photon.direction, scene.lights[0].direction);
    const vec3 local = transpose(frame) * photon.origin;
    ASSERT_LT(local.z, -3);  // before all that it may meet
    const vec2 part = (vec2(local) + kHalfSize) / (2 * kHalfSize);
    flux.add(binOf(double(part.y), kParts) * kParts + binOf(double(part.x), kParts), double(photon.flux.x));
  }
  flux.expectMeans(expected);
}

// 1 - cosine of the half angle that a ball is seen under.
double widthOfBall(double distance, double radius) {
  return 1 - std::sqrt(1 - radius * radius / (distance * distance));
}

TEST(Emission, OfATubeIsAsBrightAlongAllOfIt) {
  Scene scene;
  scene.lights = {lineLight({-1, 2, 0}, {3, 4, 1})};
  const Light& light = scene.lights[0];
  const float radius = 0.5f;
  add(scene, ball(radius), glass());
  constexpr std::size_t kAlong = 16, kRings = 8, kFine = 100;
  std::vector<double> expected(kAlong * kRings, 0.0);
  for (std::size_t i = 0; i < kAlong * kFine; ++i) {
    const double u = (double(i) + 0.5) / double(kAlong * kFine);
    const double away = length(glm::mix(glm::dvec3(light.position), glm::dvec3(light.end), u));
    for (std::size_t ring = 0; ring < kRings; ++ring)
      expected[i / kFine * kRings + ring] +=
          100 * kTurn * widthOfBall(away, double(radius * kMargin)) / double(kAlong * kRings * kFine);
  }
  const Lights lights(scene, Aim::casters);
  Random random(3);
  WeightedHistogram flux(kAlong * kRings);
  const glm::dvec3 tube(light.end - light.position);
  for (int i = 0; i < kPhotons; ++i) {
    const EmittedPhoton photon = emitted(lights, random);
    const glm::dvec3 origin(photon.origin);
    const double u = dot(origin - glm::dvec3(light.position), tube) / dot(tube, tube);
    const double width = widthOfBall(length(origin), double(radius * kMargin));
    const glm::dvec3 aside = glm::dvec3(photon.direction) + normalize(origin);
    flux.add(binOf(u, kAlong) * kRings + binOf(0.5 * dot(aside, aside) / width, kRings),
             double(photon.flux.x));
  }
  flux.expectMeans(expected);
}

TEST(Emission, IsSharedOutAmongLights) {
  Scene scene;
  scene.lights = {pointLight({0, 3, 0}, 10), sun({0, -1, 0}, 2), spotLight({0, 5, 0}, vec3(0), 3, 6, 500),
                  pointLight({0, 9, 0}, 300)};
  add(scene, ball(1), glass());
  const Lights lights(scene, Aim::casters);
  Random random(4);
  WeightedHistogram flux(4);
  for (int i = 0; i < kPhotons; ++i) {
    const EmittedPhoton photon = emitted(lights, random);
    flux.add(photon.light, double(photon.flux.x));
  }
  const double inner = std::cos(glm::radians(3.0)), outer = std::cos(glm::radians(6.0));
  const double radius(kMargin);
  // A spot's falloff is the square of what is linear in the cosine: a third of its solid angle.
  flux.expectMeans({10 * kTurn * widthOfBall(3, radius), 2 * kTurn / 2 * radius * radius,
                    500 * kTurn * ((1 - inner) + (inner - outer) / 3), 300 * kTurn * widthOfBall(9, radius)});
}

TEST(Emission, TowardNothingIsDark) {
  Scene scene;
  scene.lights = {pointLight({0, 3, 0})};
  add(scene, ball(1), diffuse(0.5f));
  EXPECT_TRUE(Lights(scene, Aim::casters).isDark());
  EXPECT_FALSE(Lights(scene, Aim::everywhere).isDark());
}

// What passes through an opening before a lamp with a size that is wholly in view is what a point would send.
TEST(Emission, LampWithASizeSendsAsMuchAsAPoint) {
  const vec3 opening(0, 0, 0);
  constexpr float kRadius = 0.4f;
  Light lamp = pointLight({0.4f, 1.5f, 0});
  lamp.radius = 0.3f;
  Light disk = sun({0.2f, -1, 0}, 1000);
  disk.angle = 15;
  for (const Light& light : {lamp, disk}) {
    Scene scene;
    scene.lights = {light};
    add(scene, ball(0.5f), glass());
    const Lights lights(scene, Aim::casters);
    const vec3 toward = light.type == LightType::directional ? -light.direction : normalize(light.position);
    Random random(3);
    double flux = 0;
    for (int i = 0; i < kPhotons; ++i) {
      const EmittedPhoton photon = emitted(lights, random);
      const float along = dot(opening - photon.origin, toward) / dot(photon.direction, toward);
      const vec3 place = photon.origin + along * photon.direction - opening;
      if (length(place) < kRadius) flux += double(photon.flux.x) / kPhotons;
    }
    const double away = double(length(light.position));
    const double expected = light.type == LightType::directional
                                ? 1000 * double(kPi) * double(kRadius) * double(kRadius)
                                : 100 * kTurn * (1 - away / std::hypot(away, double(kRadius)));
    EXPECT_NEAR(flux, expected, 0.01 * expected);  // of half of the photons: 0.2 %
  }
}

}  // namespace
}  // namespace nephroid
