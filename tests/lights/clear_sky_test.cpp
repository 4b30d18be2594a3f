// The clear sky of Preetham 1999 and its sun: against the paper's formulas, measured daylight and closed
// forms.
#include "lights/clear_sky.h"

#include "core/color.h"
#include "core/directions.h"
#include "lights/seen_skies.h"
#include "lights/sky.h"
#include "support/scene_file.h"

namespace nephroid {
namespace {

float horizontalIlluminance(const SkyMap& map) {
  float sum = 0;
  for (uint32_t y = 0; y < map.size.y / 2; ++y)
    for (uint32_t x = 0; x < map.size.x; ++x)
      sum += luminanceOf(map.luminance[std::size_t{y} * map.size.x + x]) * skyCellAngle(map, y) *
             towardSky((vec2(x, y) + 0.5f) / vec2(map.size)).y;
  return sum;
}

TEST(ClearSky, sunIsWhereItsAnglesSay) {
  const auto at = [](float azimuth, float elevation) {
    return towardSun({.azimuth = azimuth, .elevation = elevation});
  };
  EXPECT_LT(distance(at(0, 0), vec3(0, 0, -1)), 1e-6f);   // north
  EXPECT_LT(distance(at(90, 0), vec3(1, 0, 0)), 1e-6f);   // east
  EXPECT_LT(distance(at(180, 0), vec3(0, 0, 1)), 1e-6f);  // south
  EXPECT_LT(distance(at(42, 90), vec3(0, 1, 0)), 1e-6f);
  EXPECT_NEAR(at(42, 30).y, 0.5f, 1e-6f);
}

// Yz of the paper, section A.2: worked out by hand for turbidity 3.
TEST(ClearSky, zenithHasTheLuminanceOfTheFormula) {
  for (const float elevation : {20.0f, 45.0f, 70.0f}) {
    const ClearSky clear{.elevation = elevation};
    const float chi = (4.0f / 9 - 3.0f / 120) * (kPi - 2 * glm::radians(90 - elevation));
    const float expected = 1000 * ((4.0453f * 3 - 4.9710f) * std::tan(chi) - 0.2155f * 3 + 2.4192f);
    EXPECT_NEAR(luminanceOf(clearSkyLuminance(clear, vec3(0, 1, 0))), expected, 0.005f * expected);
  }
}

// Illuminance of a clear day (IESNA Lighting Handbook, 9th edition, 8-10): by the sky alone on the ground
// 0.8 + 15.5 sqrt(sine of the elevation) klx, and by the sun on a surface that faces it 127.5 exp(-0.21 /
// sine) klx. Its sun is that of turbidity 2. At 3 the sky has what the haze takes from the sun.
TEST(ClearSky, daylightIsThatOfClearDays) {
  for (const int elevation : {15, 30, 45, 60, 75}) {
    const ClearSky clear{.elevation = float(elevation)};
    const ClearSky clearest{.elevation = float(elevation), .turbidity = 2};
    const float sine = towardSun(clear).y;
    const float skyOfHandbook = 800 + 15500 * std::sqrt(sine);
    const float sunOfHandbook = 127500 * std::exp(-0.21f / sine);
    const float sky = horizontalIlluminance(clearSkyMap(clear)), sun = luminanceOf(sunIlluminance(clear));
    const auto record = [&](const char* what, float lux) {
      RecordProperty(what + std::to_string(elevation), std::to_string(lux));
    };
    record("sky_", sky);
    record("sky_of_handbook_", skyOfHandbook);
    record("sun_", sun);
    record("sun_of_handbook_", sunOfHandbook);
    record("ground_", sky + sun * sine);
    record("ground_of_handbook_", skyOfHandbook + sunOfHandbook * sine);
    EXPECT_NEAR(luminanceOf(sunIlluminance(clearest)), sunOfHandbook, 0.07f * sunOfHandbook) << elevation;
    const float both = skyOfHandbook + sunOfHandbook * sine;
    EXPECT_NEAR(sky + sun * sine, both, 0.15f * both) << elevation;
  }
  EXPECT_NEAR(luminanceOf(sunIlluminance({.elevation = 70, .turbidity = 2.5f})), 100000, 8000);
}

// The model's luminance as a whole, on the ground, worked out with other means from the paper's formulas.
TEST(ClearSky, skyHasTheIlluminanceOfItsFormulas) {
  EXPECT_NEAR(horizontalIlluminance(clearSkyMap({.elevation = 15, .turbidity = 2})), 20712, 30);
  EXPECT_NEAR(horizontalIlluminance(clearSkyMap({.elevation = 60})), 31532, 50);
}

TEST(ClearSky, lowSunsAreDimmerAndRedder) {
  const vec3 high = sunIlluminance({.elevation = 80}), low = sunIlluminance({.elevation = 5});
  EXPECT_LT(luminanceOf(low), 0.3f * luminanceOf(high));
  EXPECT_GT(low.r / low.b, 2 * high.r / high.b);
  const vec3 zenith = clearSkyLuminance({.elevation = 45}, vec3(0, 1, 0));
  EXPECT_GT(zenith.b, 1.5f * zenith.r);
}

TEST(ClearSky, groundIsLitBySkyAndSun) {
  const ClearSky clear{.elevation = 50, .ground = vec3(0.3f)};
  const SkyMap map = clearSkyMap(clear);
  const float lux = horizontalIlluminance(map) + luminanceOf(sunIlluminance(clear)) * towardSun(clear).y;
  EXPECT_NEAR(luminanceOf(map.luminance.back()), 0.3f * lux / kPi, 1e-3f * lux);
  EXPECT_EQ(map.luminance[std::size_t{map.size.x} * map.size.y / 2], map.luminance.back());
}

TEST_F(SceneFile, ClearSkyHasASunOfItsOwnWhichIsSeenAsADisk) {
  const Scene scene = load(
      "[[light]]\nname = \"day\"\ntype = \"sky\"\nmodel = \"clear\"\nsun = [90, 30]\nluminance = 0.5\n"
      "rotation = 90\ndimmer = 0.5\n");
  ASSERT_EQ(scene.lights.size(), 2u);
  const Light &sun = scene.lights[0], &sky = scene.lights[1];
  EXPECT_EQ(sky.name, "day");
  EXPECT_EQ(sky.sun, 0u);
  EXPECT_EQ(sun.type, LightType::directional);
  EXPECT_EQ(sun.angle, kSunAngle);
  // From the east, turned counterclockwise: from the north.
  EXPECT_LT(distance(-sun.direction, towardSun({.azimuth = 0, .elevation = 30})), 1e-5f);
  const ClearSky clear{.azimuth = 90, .elevation = 30};
  EXPECT_LT(distance(sun.illuminance, 0.25f * sunIlluminance(clear)), 1e-3f);
  EXPECT_EQ(sky.intensity, vec3(0.25f));

  // Illuminance is luminance times the disk's solid angle, seen at a slant.
  const SkySight sight = sightOf(scene, sky);
  const vec3 lux = sight.diskLuminance * kPi * sight.diskRadius * sight.diskRadius;
  EXPECT_LT(distance(lux, sun.illuminance), 1e-4f * luminanceOf(sun.illuminance));
  SeenSkies skies(scene);
  EXPECT_TRUE(skies.place(scene));
  EXPECT_FALSE(skies.place(scene));
  EXPECT_GT(luminanceOf(skies.luminance(-sun.direction, 0)), 1e7f);
  const vec3 beside = normalize(-sun.direction + 0.006f * vec3(0, 1, 0));
  EXPECT_LT(luminanceOf(skies.luminance(beside, 0)), 1e5f);
  EXPECT_NEAR(luminanceOf(skies.luminance(beside, 0)),
              0.25f * luminanceOf(clearSkyLuminance(clear, towardSun(clear))), 300);
}

}  // namespace
}  // namespace nephroid
