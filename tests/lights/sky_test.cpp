// Light with an extent: panels and skies, against closed forms.
#include <gtest/gtest.h>

#include <cmath>

#include "core/color.h"
#include "core/image_io.h"
#include "formats/load.h"
#include "lights/lamp_cells.h"
#include "lights/light_intensity.h"
#include "lights/sky.h"
#include "support/reference_scenes.h"
#include "support/scratch_files.h"
#include "support/statistics.h"

namespace nephroid {
namespace {

// Onto a point of a plane that is parallel to a rectangle with a corner over the point, `x` and `y` its sides
// over the distance: the part of what a sky as bright as the rectangle would send (Siegel and Howell).
double partOfCorner(double x, double y) {
  const double acrossX = std::sqrt(1 + x * x), acrossY = std::sqrt(1 + y * y);
  return (x / acrossX * std::atan(y / acrossX) + y / acrossY * std::atan(x / acrossY)) / (2 * double(kPi));
}

// lux under a panel whose corners are at (low.x, h, low.y) and (high.x, h, high.y), at the point (0, 0, 0).
double luxUnderPanel(double luminance, vec2 low, vec2 high, double h) {
  const auto corner = [&](float x, float y) {
    return std::copysign(1.0, double(x) * double(y)) *
           partOfCorner(std::abs(double(x)) / h, std::abs(double(y)) / h);
  };
  return double(kPi) * luminance *
         (corner(high.x, high.y) - corner(low.x, high.y) - corner(high.x, low.y) + corner(low.x, low.y));
}

Light panel(uvec2 grid) {
  Light light;
  light.type = LightType::area;
  light.position = {0.2f, 1.5f, -0.4f};
  light.u = {0, 0, 0.7f};
  light.v = {1, 0, 0};
  light.direction = {0, -1, 0};
  light.intensity = vec3(1000.0f * 0.7f);
  light.grid = grid;
  return light;
}

Light sky(Scene& scene, SkyMap map, uint32_t samples) {
  Light light;
  light.type = LightType::sky;
  light.skyMap = uint32_t(scene.skies.size());
  scene.skies.push_back(std::move(map));
  light.sky = skyParts(scene.skies.back(), samples);
  return light;
}

vec3 luxOf(const Scene& scene, vec3 normal) {
  const std::vector<ShapedLight> lights = shapedLights(scene);
  vec3 sum(0);
  for (const Emitter& emitter : emittersOf(scene))
    sum += std::max(-dot(emitterDirection(emitter, vec3(0)), normal), 0.0f) *
           illuminance(lights[emitter.light], emitter, vec3(0));
  return sum;
}

// On a small sensor about the origin, facing up.
SampleMean referenceLux(Scene scene) {
  add(scene, makePlane({4, 4}), diffuse(0.5f));
  const RayScene rays(scene);
  const Sensor sensor = floorSensor(vec3(0), 1e-3f, 2);
  ReferenceSensor meter(scene, rays, sensor, {.photons = 1});
  return blockMeans(meter, {"direct.G"}, 1024, 2)[0][0];
}

void expectMean(const SampleMean& mean, double expected) {
  EXPECT_LE(std::abs(mean.mean() - expected), 4 * mean.standardError())
      << mean.mean() << ", not " << expected;
}

TEST(Panel, ShinesAsTheFormulaHasIt) {
  const double expected = luxUnderPanel(1000, {0.2f, -0.4f}, {1.2f, 0.3f}, 1.5);
  Scene scene;
  scene.lights = {panel({32, 32})};
  // The rule of midpoints, of panels 1/48 of the distance wide.
  EXPECT_NEAR(double(luxOf(scene, {0, 1, 0}).x), expected, 1e-3 * expected);
  expectMean(referenceLux(scene), expected);
}

TEST(Panel, IsDarkBehind) {
  Scene scene;
  scene.lights = {panel({4, 4})};
  scene.lights[0].position.y = -1.5f;
  EXPECT_EQ(luxOf(scene, {0, -1, 0}), vec3(0));
}

TEST(Sky, ThatIsEvenSendsPiTimesItsLuminance) {
  Scene scene;
  scene.lights = {sky(scene, evenSky(), 256)};
  scene.lights[0].intensity = vec3(50);
  expectMean(referenceLux(scene), 50 * double(kPi));
  // A half space cuts parts at its edge, where they count least: of 256, some 32 by half of their cosine
  // there.
  for (const vec3 normal : {vec3(0, 1, 0), vec3(1, 0, 0), normalize(vec3(1, -2, 3))})
    EXPECT_NEAR(double(luxOf(scene, normal).x), 50 * double(kPi), 0.01 * 50 * double(kPi));
  vec3 sum(0);
  for (const SkyPart& part : scene.lights[0].sky) sum += part.illuminance;
  EXPECT_NEAR(sum.x, 4 * kPi, 1e-4f);
}

// One cell of 32 x 16 shines, in green.
SkyMap sunAt(uvec2 cell) {
  SkyMap map{"sun", {32, 16}, std::vector<vec3>(512, vec3(0))};
  map.luminance[cell.y * 32 + cell.x] = {0, 1e4f, 0};
  return map;
}

TEST(Sky, WithASunIsALightFromThere) {
  // Right of the middle by 2.5 cells of 11.25 degrees, 3.5 of 11.25 above the horizon.
  const float longitude = glm::radians(2.5f * 11.25f), latitude = glm::radians(3.5f * 11.25f);
  const vec3 toward(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                    -std::cos(longitude) * std::cos(latitude));
  Scene scene;
  scene.lights = {sky(scene, sunAt({18, 4}), 16)};
  ASSERT_EQ(scene.lights[0].sky.size(), 1u);
  EXPECT_LT(length(scene.lights[0].sky[0].direction + toward), 1e-5f);
  const double angle = 2 * double(kPi) / 32 * (std::sin(glm::radians(45.0)) - std::sin(glm::radians(33.75)));
  EXPECT_NEAR(double(scene.lights[0].sky[0].illuminance.y), 1e4 * angle, 1e-4 * 1e4 * angle);
  // The integral of the sine over the cell, in place of its middle's.
  const double upright =
      2 * double(kPi) / 32 * 0.5 *
      (std::pow(std::sin(glm::radians(45.0)), 2) - std::pow(std::sin(glm::radians(33.75)), 2));
  expectMean(referenceLux(scene), 1e4 * upright);
  scene.lights[0].skyRotation = 90;  // -z comes to -x
  EXPECT_LT(length(emittersOf(scene)[0].direction + vec3(toward.z, toward.y, -toward.x)), 1e-5f);
}

double luxOfParts(const std::vector<SkyPart>& parts, vec3 up) {
  double lux = 0;
  for (const SkyPart& part : parts)
    lux += double(part.illuminance.x) * std::max(-dot(part.direction, up), 0.0f);
  return lux;
}

// By light, of the directions about that of their part: the mean of their squares.
double meanSpread(const std::vector<SkyPart>& parts) {
  double spread = 0, all = 0;
  for (const SkyPart& part : parts) {
    const double lux = double(luminanceOf(part.illuminance));
    all += lux;
    for (const vec3 axis : part.spread) spread += lux * double(dot(axis, axis));
  }
  return spread / all;
}

// A part sends what it has from one direction, in place of the mean of the cosines: too much by half of its
// spread, which is not the same of all. The horizon is between rows of the map.
TEST(SkyParts, OfAnEvenSkyAreTheSky) {
  double before = 4;
  for (const uint32_t count : {16u, 64u, 256u, 1024u}) {
    const std::vector<SkyPart> parts = skyParts(evenSky(), count);
    EXPECT_EQ(parts.size(), count);
    double all = 0;
    for (const SkyPart& part : parts) all += double(part.illuminance.x);
    EXPECT_NEAR(all / (4 * double(kPi)), 1, 1e-5) << count;
    const double spread = meanSpread(parts), tooMuch = luxOfParts(parts, {0, 1, 0}) / double(kPi) - 1;
    EXPECT_GT(tooMuch, -1e-5) << count;
    EXPECT_LT(tooMuch, spread) << count;
    // Four times as many parts are half as wide. A square of the same solid angle has a spread of 1/6 of it.
    EXPECT_LT(spread, 0.35 * before) << count;
    EXPECT_LT(spread, 2 * 4 * double(kPi) / count / 6) << count;
    before = spread;
  }
}

TEST(SkyParts, AreAsManyAsTheSpreadTakes) {
  std::size_t before = 0;
  for (const double spread : {0.1, 0.02, 0.008}) {
    const std::vector<SkyPart> parts = skyParts(evenSky(), 4096, spread);
    EXPECT_LE(meanSpread(parts), 1.1 * spread + 2e-3);  // across its direction, with that in the map's cells
    EXPECT_GT(parts.size(), before);
    EXPECT_LT(double(parts.size()), 1.25 * 4 * double(kPi) / spread / 6);
    before = parts.size();
  }
}

// As bright as the sun beside a day's sky, with less light than that has: it stays where it is, and as small.
TEST(SkyParts, HaveASunAlone) {
  constexpr uvec2 kSize{256, 128}, kSun{40, 30};
  SkyMap map{"sky", kSize, std::vector<vec3>(std::size_t{kSize.x} * kSize.y, vec3(1))};
  map.luminance[kSun.y * kSize.x + kSun.x] = vec3(5e3f);
  const vec3 toward = towardSky((vec2(kSun) + 0.5f) / vec2(kSize));
  for (const uint32_t count : {2u, 64u}) {
    const std::vector<SkyPart> parts = skyParts(map, count);
    const auto alone = std::ranges::find_if(
        parts, [&](const SkyPart& part) { return length(part.direction + toward) < 1e-5f; });
    ASSERT_NE(alone, parts.end()) << count;
    EXPECT_FLOAT_EQ(alone->illuminance.x, 5e3f * skyCellAngle(map, kSun.y));
    EXPECT_LT(length(alone->spread[0]), kPi / float(kSize.y));
    EXPECT_EQ(parts.size(), count);
  }
}

// Across a narrow band the light spreads along it, and evenly as that is long.
TEST(SkyParts, TellWhereTheirLightSpreads) {
  constexpr uvec2 kSize{256, 128};
  SkyMap map{"sky", kSize, std::vector<vec3>(std::size_t{kSize.x} * kSize.y, vec3(0))};
  for (uint32_t x = 120; x < 136; ++x) map.luminance[63 * kSize.x + x] = vec3(1);
  const std::vector<SkyPart> parts = skyParts(map, 2);
  ASSERT_EQ(parts.size(), 2u);
  for (const SkyPart& part : parts) {
    const float cell = 2 * kPi / float(kSize.x);
    EXPECT_NEAR(length(part.spread[0]), 8 * cell / std::sqrt(12.0f), 0.02f * cell);
    EXPECT_NEAR(length(part.spread[1]), cell / std::sqrt(12.0f), 0.02f * cell);
    EXPECT_LT(std::abs(part.spread[0].y), 0.02f * length(part.spread[0]));
    EXPECT_NEAR(dot(part.spread[0], part.direction), 0, 1e-5f);
  }
}

// As many as an error asks for, and the same ones again; other maps have parts of their own.
TEST(CutSkies, KeepTheirParts) {
  CutSkies skies;
  const SkyMap even = evenSky();
  const std::span<const SkyPart> parts = skies.partsOf(even, 0.01f, 4096);
  EXPECT_GT(parts.size(), 200u);
  EXPECT_LT(parts.size(), 320u);
  const std::size_t few = skies.partsOf(even, 0.05f, 4096).size();
  EXPECT_LT(few, parts.size() / 4);
  SkyMap half = even;
  for (std::size_t i = half.luminance.size() / 2; i < half.luminance.size(); ++i) half.luminance[i] = vec3(0);
  EXPECT_LT(skies.partsOf(half, 0.05f, 4096).size(), few);
  EXPECT_EQ(skies.partsOf(even, 0.05f, 4096).size(), few);
  EXPECT_EQ(skies.partsOf(even, 0.01f, 4096).data(), parts.data());
}

class ExtendedLights : public ScratchFiles {
 protected:
  Scene loaded(const std::string& light) const {
    return loadScene(write("scene.toml", "[[light]]\n" + light));
  }
  std::string errorOf(const std::string& light) const {
    return inputErrorOf([&] { loaded(light); });
  }
  void writeSky(const std::vector<float>& values) const {
    Image image{2, 1, {}};
    for (const char* name : {"R", "G", "B"}) image.channel(name) = values;
    writeExr(folder() / "sky.exr", image);
  }
};

TEST_F(ExtendedLights, AreReadFromAFile) {
  const Scene area = loaded(
      "type = \"area\"\ncorner = [0, 2, 0]\nu = [0, 0, 3]\nv = [2, 0, 0]\nluminance = 100\nsamples = [2, "
      "3]\n");
  EXPECT_EQ(area.lights[0].direction, vec3(0, -1, 0));
  EXPECT_FLOAT_EQ(area.lights[0].intensity.x, 600);
  EXPECT_EQ(emittersOf(area).size(), 6u);
  const Scene byFlux =
      loaded("type = \"area\"\ncorner = [0, 2, 0]\nu = [0, 0, 3]\nv = [2, 0, 0]\nflux = 314.159265\n");
  EXPECT_FLOAT_EQ(byFlux.lights[0].intensity.x, 100);
  writeSky({1, 3});
  const Scene sky = loaded("type = \"sky\"\nmap = \"sky.exr\"\nsamples = 2\nluminance = 2\n");
  ASSERT_EQ(emittersOf(sky).size(), 2u);
  // The left half is toward -x.
  EXPECT_LT(length(emittersOf(sky)[0].direction - vec3(1, 0, 0)), 1e-6f);
  EXPECT_FLOAT_EQ(emittersOf(sky)[1].power.x, 2 * 3 * 2 * kPi);
  EXPECT_TRUE(sky.lights[0].hasGivenSamples);
  EXPECT_FALSE(loaded("type = \"sky\"\nluminance = 2\n").lights[0].hasGivenSamples);
}

TEST_F(ExtendedLights, ThatAreWrongSayWhere) {
  const std::string area = "type = \"area\"\ncorner = [0, 2, 0]\nu = [2, 0, 0]\n";
  EXPECT_NE(errorOf(area + "v = [1, 0, 0]\nluminance = 1\n").find("span no area"), std::string::npos);
  EXPECT_NE(errorOf(area + "v = [0, 0, 1]\nluminance = 1\nflux = 2\n").find("give one of them"),
            std::string::npos);
  EXPECT_NE(errorOf(area + "v = [0, 0, 1]\n").find("luminance"), std::string::npos);
  EXPECT_NE(errorOf("type = \"sky\"\n").find("\"map\""), std::string::npos);
  EXPECT_NE(errorOf("type = \"sky\"\nmap = \"none.exr\"\n").find("not there"), std::string::npos);
  writeSky({0, 0});
  EXPECT_NE(errorOf("type = \"sky\"\nmap = \"sky.exr\"\n").find("dark all over"), std::string::npos);
  writeSky({1, -1});
  EXPECT_NE(errorOf("type = \"sky\"\nmap = \"sky.exr\"\n").find("below 0"), std::string::npos);
}

}  // namespace
}  // namespace nephroid
