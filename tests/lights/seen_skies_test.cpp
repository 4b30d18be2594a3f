// Skies as they are seen: lookups in maps, their coarser levels, disks, and what a scene file says of them.
#include "lights/seen_skies.h"

#include "core/directions.h"
#include "lights/sky.h"
#include "support/scene_file.h"

namespace nephroid {
namespace {

// Directions spread evenly over the sphere.
std::vector<vec3> directions(uint32_t count) {
  std::vector<vec3> all;
  for (uint32_t i = 0; i < count; ++i)
    all.push_back(sampleCone(pointOnCurve((double(i) + 0.5) / double(count)), 2));
  return all;
}

Scene sceneOf(SkyMap map, float rotation = 0) {
  Scene scene;
  Light light;
  light.type = LightType::sky;
  light.skyMap = 0;
  light.skyRotation = rotation;
  light.sky = skyParts(map, 4);
  scene.skies.push_back(std::move(map));
  scene.lights.push_back(light);
  return scene;
}

// With one bright cell.
SkyMap brightCell(uvec2 size, uvec2 at) {
  SkyMap map{"one cell", size, std::vector<vec3>(std::size_t{size.x} * size.y, vec3(0))};
  map.luminance[std::size_t{at.y} * size.x + at.x] = vec3(1000);
  return map;
}

TEST(SeenSkies, middlesOfCellsShowTheirCells) {
  SkyMap map{"numbers", {7, 5}, {}};
  for (uint32_t i = 0; i < 35; ++i) map.luminance.emplace_back(float(i), 1, 0);
  const Scene scene = sceneOf(map, 33);
  SeenSkies skies(scene);
  skies.place(scene);
  for (uint32_t y = 0; y < 5; ++y)
    for (uint32_t x = 0; x < 7; ++x) {
      const vec3 toward = skyTurned(33) * towardSky((vec2(x, y) + 0.5f) / vec2(7, 5));
      EXPECT_NEAR(skies.luminance(toward, 0).x, float(7 * y + x), 1e-3f);
    }
}

TEST(SeenSkies, columnsJoinBehind) {
  const Scene scene = sceneOf(brightCell({16, 8}, {15, 4}));
  SeenSkies skies(scene);
  skies.place(scene);
  const float row = 4.5f / 8;
  EXPECT_NEAR(skies.luminance(towardSky({0.0f, row}), 0).x, 500, 1);
  EXPECT_NEAR(skies.luminance(towardSky({1.0f, row}), 0).x, 500, 1);
}

// What is seen all around is the light's illuminance, however wide the looks are.
TEST(SeenSkies, looksOfAnyWidthSeeTheSameInTheMean) {
  for (const uvec2 size : {uvec2(64, 32), uvec2(50, 27)}) {
    const SkyMap map = brightCell(size, {size.x / 3, size.y / 3});
    const Scene scene = sceneOf(map);
    SeenSkies skies(scene);
    skies.place(scene);
    const float flux = 1000 * skyCellAngle(map, size.y / 3);
    const std::vector<vec3> looks = directions(400000);
    for (const float width : {0.0f, 0.15f, 0.4f}) {
      double sum = 0;
      for (const vec3& toward : looks) sum += double(skies.luminance(toward, width).x);
      EXPECT_NEAR(sum * 4 * double(kPi) / double(looks.size()) / double(flux), 1, 0.06) << width;
    }
  }
}

TEST(SeenSkies, wideLooksDoNotMissSmallLights) {
  const Scene scene = sceneOf(brightCell({512, 256}, {200, 100}));
  SeenSkies skies(scene);
  skies.place(scene);
  const vec3 middle = towardSky((vec2(200, 100) + 0.5f) / vec2(512, 256));
  const vec3 beside = normalize(middle + 0.04f * vec3(0, 1, 0));
  EXPECT_EQ(skies.luminance(beside, 0).x, 0);
  EXPECT_GT(skies.luminance(beside, 0.1f).x, 0.2f);
}

TEST(SeenSkies, disksHaveTheSameLightAtAnyWidth) {
  Scene scene = sceneOf(brightCell({8, 4}, {0, 0}));
  scene.lights[0].intensity = vec3(0);
  Light sun;
  sun.type = LightType::directional;
  sun.direction = normalize(vec3(-0.2f, -1, 0.3f));
  sun.illuminance = vec3(1e5f, 9e4f, 8e4f);
  sun.angle = 4;
  scene.lights.push_back(sun);
  scene.lights[0].sun = 1;
  SeenSkies skies(scene);
  skies.place(scene);
  const mat3 frame = frameAround(-sun.direction);
  constexpr uint32_t kLooks = 200000;
  constexpr float kCone = 0.02f;
  for (const float width : {0.0f, 0.02f, 0.15f}) {
    double sum = 0;
    for (uint32_t i = 0; i < kLooks; ++i) {
      const vec3 toward =
          normalize(frame * sampleCone(pointOnCurve((double(i) + 0.5) / double(kLooks)), kCone));
      sum += double(skies.luminance(toward, width).x * -dot(toward, sun.direction));
    }
    EXPECT_NEAR(sum / kLooks / double(coneDensity(kCone)), 1e5, 1e3) << width;
  }
}

TEST(SeenSkies, skiesAddUp) {
  Scene scene = sceneOf(evenSky());
  scene.lights.push_back(scene.lights[0]);
  scene.lights[1].intensity = vec3(2, 3, 4);
  scene.lights.push_back(scene.lights[0]);
  scene.lights[2].isSeen = false;
  SeenSkies skies(scene);
  skies.place(scene);
  EXPECT_LT(distance(skies.luminance(vec3(0, 0, 1), 0.01f), vec3(3, 4, 5)), 1e-5f);
}

constexpr const char* kSky = "[[light]]\ntype = \"sky\"\nluminance = 100\n";

TEST_F(SceneFile, SkiesAreSeenUnlessTheSceneSaysOtherwise) {
  EXPECT_TRUE(load(kSky).lights[0].isSeen);
  EXPECT_FALSE(load(std::string(kSky) + "visible = false\n").lights[0].isSeen);
  const std::string background = "[environment]\nbackground = 0\n";
  EXPECT_FALSE(load(background + kSky).lights[0].isSeen);
  EXPECT_TRUE(load(background + kSky + "visible = true\n").lights[0].isSeen);
  expectError(std::string(kSky) + "visible = 1\n", {"scene.toml:4", "visible", "true or false"});
}

TEST_F(SceneFile, SaysWhatIsWrongWithAClearSky) {
  const std::string sky = "[[light]]\ntype = \"sky\"\nmodel = \"clear\"\n";
  expectError(sky, {"sun", "[azimuth, elevation]"});
  expectError(sky + "sun = 40\n", {"scene.toml:4", "sun", "array of 2 numbers"});
  expectError(sky + "sun = [0, 91]\n", {"scene.toml:4", "elevation from 0 to 90"});
  expectError(sky + "sun = [0, -1]\n", {"elevation from 0 to 90"});
  expectError(sky + "sun = [720, 1]\n", {"azimuth from -360 to 360"});
  expectError(sky + "sun = [0, 40]\nturbidity = 1\n", {"scene.toml:5", "turbidity", "2 to 10"});
  expectError(sky + "sun = [0, 40]\nground = 2\n", {"ground", "0 to 1"});
  expectError(sky + "sun = [0, 40]\nmap = \"a.exr\"\n", {"map", "model"});
  expectError("[[light]]\ntype = \"sky\"\nmodel = \"cloudy\"\n", {"cloudy", "clear"});
  expectError(std::string(kSky) + "turbidity = 3\n", {"turbidity", "model = \"clear\""});
}

TEST_F(SceneFile, ScenesWithoutLightHaveASkyAndASun) {
  const std::string ball = kMaterials + "[[object]]\nmaterial = \"glass\"\nshape = \"sphere\"\nradius = 1\n";
  const Scene scene = load(ball);
  ASSERT_EQ(scene.lights.size(), 2u);
  EXPECT_TRUE(scene.hasDefaultSky);
  EXPECT_EQ(scene.lights[1].sun, 0u);
  EXPECT_NEAR(-scene.lights[0].direction.y, std::sin(glm::radians(40.0f)), 1e-5f);
  EXPECT_TRUE(scene.lights[1].isSeen);
  EXPECT_FALSE(load("[environment]\nbackground = 1\n" + ball).lights[1].isSeen);
  for (const char* lit : {"light = []\n", "[environment]\nambient = 1\n", kSky})
    EXPECT_FALSE(load(lit + ball).hasDefaultSky) << lit;
  EXPECT_TRUE(load("light = []\n" + ball).lights.empty());
}

}  // namespace
}  // namespace nephroid
