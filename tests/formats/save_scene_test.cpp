// What is changed by hand and saved loads again as it was.
#include "formats/save_scene.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "core/error.h"
#include "formats/scene_toml.h"
#include "lights/clear_sky.h"
#include "scene/dispersion.h"
#include "support/photons.h"
#include "water/wave_simulation.h"

namespace nephroid {
namespace {

namespace fs = std::filesystem;

std::vector<fs::path> exampleScenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(fs::path(NEPHROID_SOURCE_DIR) / "scenes"))
    if (entry.path().extension() == ".toml") files.push_back(entry.path());
  return files;
}

bool isNear(float a, float b) {
  return a == b || std::abs(a - b) <= 2e-5f * std::max({std::abs(a), std::abs(b), 0.1f});
}

bool isNear(vec3 a, vec3 b) {
  return isNear(a.x, b.x) && isNear(a.y, b.y) && isNear(a.z, b.z);
}

void expectAlike(const Scene& a, const Scene& b) {
  EXPECT_EQ(a.camera, b.camera);
  EXPECT_EQ(a.environment, b.environment);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_TRUE(isNear(a.materials[i].color, b.materials[i].color)) << a.materials[i].name;
    EXPECT_TRUE(isNear(a.materials[i].ior, b.materials[i].ior)) << a.materials[i].name;
    EXPECT_EQ(a.materials[i].attenuationColor, b.materials[i].attenuationColor) << a.materials[i].name;
    EXPECT_EQ(a.materials[i].attenuationDistance, b.materials[i].attenuationDistance) << a.materials[i].name;
  }
  ASSERT_EQ(a.objects.size(), b.objects.size());
  for (std::size_t i = 0; i < a.objects.size(); ++i) {
    const Placement& one = a.objects[i].placement;
    const Placement& other = b.objects[i].placement;
    for (const vec3 corner : {vec3(0), vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)})
      EXPECT_LT(distance(one.point(corner), other.point(corner)), 2e-5f * (1 + length(one.point(corner))))
          << a.objects[i].name;
  }
  ASSERT_EQ(a.lights.size(), b.lights.size());
  for (std::size_t i = 0; i < a.lights.size(); ++i) {
    const Light& one = a.lights[i];
    const Light& other = b.lights[i];
    EXPECT_TRUE(isNear(one.position, other.position)) << one.name;
    EXPECT_TRUE(isNear(one.end, other.end)) << one.name;
    EXPECT_EQ(one.radius, other.radius) << one.name;
    EXPECT_EQ(one.angle, other.angle) << one.name;
    EXPECT_LT(distance(one.direction, other.direction), 1e-5f) << one.name;
    if (one.type == LightType::directional)
      EXPECT_TRUE(isNear(one.illuminance, other.illuminance)) << one.name;
    else
      EXPECT_TRUE(isNear(one.intensity, other.intensity)) << one.name;
    EXPECT_TRUE(isNear(one.innerAngle, other.innerAngle)) << one.name;
    EXPECT_TRUE(isNear(one.outerAngle, other.outerAngle)) << one.name;
    EXPECT_TRUE(isNear(one.goboRotation, other.goboRotation)) << one.name;
  }
  ASSERT_EQ(a.medium.has_value(), b.medium.has_value());
  if (!a.medium) return;
  EXPECT_EQ(a.medium->extinction, b.medium->extinction);
  EXPECT_EQ(a.medium->albedo, b.medium->albedo);
  EXPECT_EQ(a.medium->g, b.medium->g);
}

// Everything that the viewer can change.
Scene changed(Scene scene) {
  scene.camera.position += vec3(0.1f, 0.2f, -0.3f);
  scene.camera.verticalFov += 1.5f;
  scene.camera.exposure = 1.25f;
  scene.camera.up = {0, 1, 0};
  scene.environment.ambient += vec3(0.25f, 0.5f, 1);
  for (Material& material : scene.materials) {
    if (material.type != MaterialType::dielectric) {
      material.color *= vec3(0.5f, 0.9f, 0.7f);
    } else if (material.dispersion > 0) {
      setDispersion(material, 1.61, 0.4);
    } else {
      material.ior += 0.01f;
      material.attenuationColor = {0.5f, 0.6f, 0.7f};
      material.attenuationDistance = 0.75f;
    }
  }
  for (Object& object : scene.objects) {
    object.placement.translation += vec3(0.1f, 0.01f, -0.2f);
    object.placement.rotation =
        normalize(glm::angleAxis(0.4f, normalize(vec3(1, 2, 3))) * object.placement.rotation);
    object.placement.scale *= 1.125f;
  }
  const std::vector<Light> before = scene.lights;
  for (Light& light : scene.lights) {
    light.position += vec3(0.3f, 0.1f, 0.2f);
    if (light.type == LightType::line) light.end += vec3(0.1f, 0.1f, 0.2f);
    if (light.type == LightType::spot || light.type == LightType::directional)
      light.direction = normalize(light.direction + vec3(0.1f, -0.2f, 0.05f));
    if (light.type == LightType::area) light.v *= 1.5f;
    if (light.type == LightType::sky) light.skyRotation += 20;
    if (light.type == LightType::sky || light.type == LightType::directional) light.position = vec3(0);
    if (light.type == LightType::directional) {
      light.illuminance *= vec3(0.5f, 0.75f, 1);
    } else {
      light.intensity *= vec3(0.5f, 0.75f, 1);
    }
  }
  for (std::size_t i = 0; i < before.size(); ++i)
    if (const uint32_t sun = before[i].sun; sun != kNone)
      scene.lights[sun] = sunWithSky(before[sun], before[i], scene.lights[i]);
  if (scene.medium) {
    scene.medium->extinction *= 1.5f;
    scene.medium->albedo *= 0.5f;
  }
  return scene;
}

TEST(SavedScenes, LoadsTheScenesAsTheyWereChanged) {
  if (kIsSanitized)
    GTEST_SKIP() << "it takes minutes under the sanitizers, in code that other tests go through too";
  for (const fs::path& file : exampleScenes()) {
    SCOPED_TRACE(file.filename());
    // As many vertices as there are without asking: making more of them takes long, and saves no better.
    const std::string text = std::regex_replace(readSceneFile(file), std::regex("\\nvertices = [0-9]+"), "");
    const Scene before = readTomlScene(text, file, 1.5);
    EXPECT_EQ(savedScene(text, before, before).text, text);
    const Scene after = changed(before);
    const SavedScene saved = savedScene(text, before, after);
    EXPECT_TRUE(saved.notSaved.empty());
    expectAlike(readTomlScene(saved.text, file, 1.5), after);
  }
}

Scene sceneOf(const std::string& text, double time = 0) {
  return readTomlScene(text, "scene.toml", time);
}

TEST(SavedScene, KeepsWhatIsWrittenAroundAValue) {
  const std::string text =
      "# größer\n[[light]]\nname = \"ä\" # one\ntype = \"point\"\n  position = [0, 2,\n   1] # there\n"
      "intensity = 3.50 # cd\n";
  const Scene before = sceneOf(text);
  Scene after = before;
  after.lights[0].position.y = 2.25f;
  EXPECT_EQ(savedScene(text, before, after).text,
            "# größer\n[[light]]\nname = \"ä\" # one\ntype = \"point\"\n  position = [0, 2.25, 1] # there\n"
            "intensity = 3.50 # cd\n");
}

TEST(SavedScene, AddsKeysAndSectionsThatWereNotThere) {
  const std::string text =
      "light = []\nmaterial = [{ name = \"glass\", type = \"dielectric\" }]\n[[object]]\nshape = "
      "\"sphere\"\nmaterial = \"glass\" # clear\n";
  const Scene before = sceneOf(text);
  Scene after = before;
  after.camera.position.x += 1;
  after.camera.up = {0, 1, 0};
  after.environment.ambient = {1, 2, 3};
  after.materials[0].ior = vec3(1.7f);
  after.objects[0].placement.scale = 2;
  const SavedScene saved = savedScene(text, before, after);
  EXPECT_NE(saved.text.find("# clear"), std::string::npos);
  expectAlike(sceneOf(saved.text), after);
}

// By the key that the file has.
TEST(SavedScene, KeepsHowPicturesAreShown) {
  const std::string camera = "[camera]\nposition = [0, 0, 1]\n";
  const auto saved = [](const std::string& text, std::optional<float> exposure, ToneCurve tone) {
    const Scene before = sceneOf(text);
    Scene after = before;
    after.camera.exposure = exposure;
    after.camera.tone = tone;
    const std::string written = savedScene(text, before, after).text;
    const Camera read = sceneOf(written).camera;
    EXPECT_EQ(read.exposure.has_value(), exposure.has_value()) << written;
    if (exposure) {
      EXPECT_NEAR(*read.exposure, *exposure, 1e-5f * *exposure) << written;
    }
    EXPECT_EQ(read.tone, tone) << written;
    return written;
  };
  EXPECT_NE(saved(camera, 0.5f, ToneCurve::agx).find("exposure = 0.5\n"), std::string::npos);
  EXPECT_NE(saved(camera + "exposure = 2\n", {}, ToneCurve::neutral).find("exposure = \"auto\""),
            std::string::npos);
  EXPECT_EQ(saved(camera + "ev100 = 10\n", 0.01f, ToneCurve::neutral).find("exposure"), std::string::npos);
  EXPECT_EQ(saved(camera + "ev100 = 10\n", {}, ToneCurve::aces).find("ev100"), std::string::npos);
  EXPECT_EQ(saved(camera + "exposure = \"auto\"\n", {}, ToneCurve::neutral),
            camera + "exposure = \"auto\"\n");
}

TEST(SavedScene, SkiesAreSeenAsBefore) {
  const std::string text =
      "[[light]]\ntype = \"sky\"\nluminance = 3\n[[light]]\nname = \"day\"\ntype = \"sky\"\nmodel = "
      "\"clear\"\nsun = [30, 40]\n";
  const Scene before = sceneOf(text);
  Scene after = before;
  ASSERT_EQ(after.lights.size(), 3u);
  after.lights[1].isSeen = false;
  after.lights[2].intensity = vec3(0.5f);
  after.lights[2].skyRotation = 25;
  after.lights[0] = sunWithSky(before.lights[0], before.lights[2], after.lights[2]);
  after.environment.background = vec3(7);
  const SavedScene saved = savedScene(text, before, after);
  EXPECT_TRUE(saved.notSaved.empty());
  const Scene again = sceneOf(saved.text);
  EXPECT_FALSE(again.lights[1].isSeen);
  EXPECT_TRUE(again.lights[2].isSeen);
  EXPECT_EQ(again.environment.background, vec3(7));
  EXPECT_LT(distance(again.lights[0].direction, after.lights[0].direction), 1e-5f);
  EXPECT_LT(distance(again.lights[0].illuminance, after.lights[0].illuminance), 1);
  // A sun that was turned by itself is not in the file.
  after.lights[0].direction = vec3(0, -1, 0);
  EXPECT_EQ(savedScene(text, before, after).notSaved, std::vector<std::string>{"day sun"});
}

TEST(SavedScene, TellsWhatDoesNotGoWithTheDefaultSky) {
  const std::string text = "[camera]\nposition = [0, 1, 3]\n";
  const Scene before = sceneOf(text);
  Scene after = before;
  after.environment.ambient = vec3(1);
  EXPECT_EQ(savedScene(text, before, after).notSaved.size(), 1u);
  EXPECT_EQ(savedScene(text, before, after).text, text);
  after.environment.background = vec3(2);
  EXPECT_EQ(savedScene(text, before, after).notSaved.size(), 2u);
  EXPECT_EQ(savedScene(text, before, after).text, text);
}

TEST(SavedScene, LampsKeepTheirSize) {
  const std::string text =
      "[[light]]\ntype = \"point\"\nposition = [0, 3, 0]\nintensity = 1\n[[light]]\ntype = \"directional\"\n"
      "direction = [0, -1, 0]\nilluminance = 1\nangle = \"sun\"\n";
  const Scene before = sceneOf(text);
  Scene after = before;
  after.lights[0].radius = 0.25f;
  expectAlike(sceneOf(savedScene(text, before, after).text), after);
  after.lights[1].angle = 2;
  expectAlike(sceneOf(savedScene(text, before, after).text), after);
}

// A moving head that is dimmed and zoomed: what is not touched goes on moving.
constexpr const char* kCue = R"([[light]]
type = "spot"
position = [0, 3, 0]
target = [0, 0, 0.5]
outer_angle = 20
flux = [100, 200, 300]
dimmer = [[0, 1], [2, 0.5]]
zoom = [[0, 20], [2, 10]]
pan = [[0, 0], [2, 90]]
)";

TEST(SavedScene, ABrighterLightGoesOnWithItsCue) {
  const Scene before = sceneOf(kCue, 1);
  Scene after = before;
  after.lights[0].intensity *= vec3(2, 1, 0.5f);
  const std::string saved = savedScene(kCue, before, after).text;
  expectAlike(sceneOf(saved, 1), after);
  Scene later = sceneOf(kCue, 2);
  later.lights[0].intensity *= vec3(2, 1, 0.5f);
  expectAlike(sceneOf(saved, 2), later);
}

TEST(SavedScene, ALightThatIsTurnedOrZoomedByHandEndsThatCue) {
  const Scene before = sceneOf(kCue, 1);
  Scene after = before;
  after.lights[0].position.x = 1;
  after.lights[0].direction = normalize(vec3(1, -1, 0));
  after.lights[0].outerAngle = 30;
  after.lights[0].innerAngle = 5;
  expectAlike(sceneOf(savedScene(kCue, before, after).text, 1), after);
}

TEST(SavedScene, ALightThatIsSwitchedOnAgainIsAsBrightAsItWasMade) {
  const std::string dark = "[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 5\ndimmer = 0\n";
  const Scene before = sceneOf(dark);
  Scene after = before;
  after.lights[0].intensity = vec3(7);
  expectAlike(sceneOf(savedScene(dark, before, after).text), after);
}

// Water with this between its heading and the next; what is saved of it with two stones more.
struct StonesSaved {
  Scene after;
  SavedScene saved;
};

StonesSaved withStones(const std::string& simulation) {
  const std::string text =
      "material = [{ name = \"w\", type = \"dielectric\" }]\n[[object]]\nshape = \"water\"\n"
      "grid = [9, 9]\nmaterial = \"w\"\n" +
      simulation + "\n[environment]\nambient = 1\n";
  const Scene before = sceneOf(text, 0.5);
  Scene after = before;
  Water& water = *after.objects[0].water;
  if (!water.simulation) water.simulation.emplace();
  water.simulation->drops.push_back({0.25f, {0.1f, -0.2f}, 0.05f, 0.01f});
  water.simulation->drops.push_back({0.3f, {0.3f, 0.2f}, 0.07f, 0.02f});
  return {after, savedScene(text, before, after)};
}

TEST(SavedScene, KeepsStonesThatFellIntoWaterHoweverItsDropsAreWritten) {
  for (const char* simulation :
       {"", "simulation = { speed = 2 }", "[object.simulation]\nspeed = 2 # m/s\n",
        "[object.simulation]\ndrops = []\n",
        "[object.simulation]\ndrops = [{ time = 0.1 }, { time = 0.2 }]\n",
        "[object.simulation]\ndrops = [\n  { time = 0.1 }, # one\n  { time = 0.2 }\n]\n",
        "[object.simulation]\nspeed = 2\n[[object.simulation.drops]]\ntime = 0.1 # one\n"}) {
    SCOPED_TRACE(simulation);
    const StonesSaved stones = withStones(simulation);
    EXPECT_TRUE(stones.saved.notSaved.empty());
    const std::string commented = std::string(simulation).find("# one") != std::string::npos ? "# one" : "";
    EXPECT_NE(stones.saved.text.find(commented), std::string::npos);
    const Scene loaded = sceneOf(stones.saved.text, 0.5);
    const WaveSimulation& is = *loaded.objects[0].water->simulation;
    const WaveSimulation& was = *stones.after.objects[0].water->simulation;
    EXPECT_EQ(is.speed, was.speed);
    EXPECT_TRUE(std::ranges::is_permutation(is.drops, was.drops)) << stones.saved.text;
  }
}

TEST(SavedScene, TakesBackStonesThatWereSaved) {
  const StonesSaved stones = withStones("[object.simulation]\ndrops = [{ time = 0.1 }]\n");
  const Scene before = sceneOf(stones.saved.text, 0.5);
  Scene after = before;
  after.objects[0].water->simulation->drops.pop_back();
  const SavedScene saved = savedScene(stones.saved.text, before, after);
  EXPECT_EQ(sceneOf(saved.text, 0.5).objects[0].water->simulation->drops,
            after.objects[0].water->simulation->drops);
}

TEST(SavedScene, SaysWhatHasNoPlaceInTheFile) {
  const Scene before = sceneOf("[[light]]\ntype = \"point\"\nposition = [0, 1, 0]\nintensity = 5\n");
  Scene after = before;
  after.lights[0].position.x = 1;
  EXPECT_EQ(savedScene("", before, after).notSaved, std::vector<std::string>{"light 1"});
}

TEST(SavedScene, WhatIsNoTomlAnyMoreIsAnError) {
  const Scene scene = sceneOf("");
  EXPECT_THROW(savedScene("[[light", scene, scene), InputError);
}

}  // namespace
}  // namespace nephroid
