// Caustics of lamps with a size against the mean of many points of the lamp, each with beams of its own.
#include <gtest/gtest.h>

#include "lights/lamp_light.h"
#include "lights/sky.h"
#include "support/reference_scenes.h"
#include "techniques/adaptive_beams/sensor_light.h"

namespace nephroid {
namespace {

constexpr uint32_t kTexels = 48;

Scene ballScene(const Light& lamp) {
  Scene scene;
  add(scene, makeSphere(0.4f, {.vertices = 600}), glass(), {0, 0.7f, 0});
  add(scene, makePlane({6, 6}), diffuse(0.5f), {0, -0.01f, 0});
  scene.lights = {lamp};
  Sensor sensor;
  sensor.corner = {-0.8f, 0, -0.8f};
  sensor.u = {1.6f, 0, 0};
  sensor.v = {0, 0, 1.6f};
  sensor.resolution = uvec2(kTexels);
  scene.sensors = {sensor};
  return scene;
}

std::vector<vec3> luxOf(const Scene& scene) {
  const RayScene rays(scene);
  RayMesh mesh;
  Progress progress;
  return lightOnSensor(scene, rays, scene.sensors[0], {}, mesh, progress);
}

// Of as many points of the lamp as there are in a square of `side`.
std::vector<double> meanOfPoints(const Light& lamp, uint32_t side) {
  std::vector<double> mean(kTexels * kTexels, 0.0);
  for (uint32_t y = 0; y < side; ++y)
    for (uint32_t x = 0; x < side; ++x) {
      const vec2 at = (vec2(float(x), float(y)) + 0.5f) / float(side);
      Light point = lamp;
      point.radius = point.angle = 0;
      if (lamp.type == LightType::directional) {
        const LightFromAfar part = lampFromAfar(lamp, at);
        point.direction = part.direction;
        point.illuminance = part.illuminance;
      } else {
        // Of a ball, the disk that the caster's middle sees.
        const vec3 toward = normalize(vec3(0, 0.7f, 0) - lamp.position),
                   origin = lampOrigin(lamp, toward, at);
        point.position = origin - dot(origin - lamp.position, toward) * toward;
      }
      const std::vector<vec3> lux = luxOf(ballScene(point));
      for (std::size_t i = 0; i < lux.size(); ++i) mean[i] += double(lux[i].x) / double(side * side);
    }
  return mean;
}

struct Difference {
  double flux = 0;  // ratio
  double rmse = 0;  // over the mean, without the hundredth of the texels that is worst
};

Difference differenceOf(const std::vector<vec3>& lux, const std::vector<double>& truth) {
  double sum = 0, sumOfTruth = 0;
  std::vector<double> squares;
  for (std::size_t i = 0; i < truth.size(); ++i) {
    sum += double(lux[i].x);
    sumOfTruth += truth[i];
    squares.push_back(std::pow(double(lux[i].x) - truth[i], 2));
  }
  std::sort(squares.begin(), squares.end());
  squares.resize(squares.size() * 99 / 100);
  double all = 0;
  for (const double square : squares) all += square;
  const double mean = sumOfTruth / double(truth.size());
  return {sum / sumOfTruth, std::sqrt(all / double(squares.size())) / mean};
}

TEST(SoftCaustics, OfTheSunAreTheMeanOfItsDisk) {
  for (const float angle : {0.53f, 5.0f}) {
    Light lamp = sun({0.3f, -1, 0.2f}, 10);
    lamp.angle = angle;
    const Difference off = differenceOf(luxOf(ballScene(lamp)), meanOfPoints(lamp, 8));
    EXPECT_NEAR(off.flux, 1, 0.005) << angle;
    EXPECT_LT(off.rmse, 0.02) << angle;
  }
}

// From the middle of a ball of glass all light comes out along the radii, in the end. What moves with the
// square of the lamp's radius over the ball's is left out.
TEST(SoftCaustics, OfALampInTheMiddleOfGlassLandWhereItsLightGoes) {
  Light lamp = pointLight({0, 0.7f, 0}, 6);
  lamp.radius = 0.05f;
  double lux = 0;
  for (const vec3& texel : luxOf(ballScene(lamp))) lux += double(texel.x) / (kTexels * kTexels);
  const double half = 0.8, height = 0.7;
  const double steradians = 4 * std::asin(half * half / (half * half + height * height));
  EXPECT_NEAR(lux * 4 * half * half / (6 * steradians), 1, std::pow(0.05 / 0.4, 2));
}

TEST(SoftCaustics, OfABallAreTheMeanOfItsPoints) {
  Light lamp = pointLight({0.5f, 2.5f, 0.3f}, 30);
  lamp.radius = 0.12f;
  const Difference off = differenceOf(luxOf(ballScene(lamp)), meanOfPoints(lamp, 8));
  EXPECT_NEAR(off.flux, 1, 0.005);
  EXPECT_LT(off.rmse, 0.02);
}

// A lamp without a size is traced as ever, and one that is very small lands as that does.
TEST(SoftCaustics, OfASmallLampAreThoseOfAPoint) {
  Light lamp = pointLight({0.5f, 2.5f, 0.3f}, 30);
  const std::vector<vec3> sharp = luxOf(ballScene(lamp));
  lamp.radius = 1e-5f;
  const std::vector<vec3> soft = luxOf(ballScene(lamp));
  for (std::size_t i = 0; i < sharp.size(); ++i) EXPECT_NEAR(soft[i].x, sharp[i].x, 0.01f * (1 + sharp[i].x));
}

// Wherever light that a ball of clear glass sends to a point comes from, it is as bright as the even sky. A
// sky is some 256 parts for the error of 1 %; what a part spreads over is off by the square of its 0.09
// radians, and the ball's triangles are within it by a thousandth of its area.
TEST(SoftCaustics, OfAnEvenSkyAreAsBrightAsTheSky) {
  constexpr float kRadius = 0.4f, kHeight = 0.7f;
  Light sky;
  sky.type = LightType::sky;
  sky.skyMap = 0;
  sky.sky = skyParts(evenSky(), 16);
  Scene scene = ballScene(sky);
  scene.skies = {evenSky()};
  scene.meshes[0] = makeSphere(kRadius, {.vertices = 2000});
  scene.objects.resize(1);  // no floor: a ball between a sensor and the sky on all sides
  std::vector<double> truth;
  for (uint32_t i = 0; i < kTexels * kTexels; ++i) {
    const vec2 texel(float(i % kTexels), float(i / kTexels));
    const vec2 aside = ((texel + 0.5f) / float(kTexels) - 0.5f) * 1.6f;
    const float squared = dot(aside, aside) + kHeight * kHeight;
    truth.push_back(double(kPi * kRadius * kRadius / squared * kHeight / std::sqrt(squared)));
  }
  const Difference off = differenceOf(luxOf(scene), truth);
  EXPECT_NEAR(off.flux, 1, 0.09 * 0.09);
  EXPECT_LT(off.rmse, 0.02);
  // With the parts that its file asks for, too few of them.
  scene.lights[0].hasGivenSamples = true;
  EXPECT_GT(differenceOf(luxOf(scene), truth).rmse, 0.1);
}

}  // namespace
}  // namespace nephroid
