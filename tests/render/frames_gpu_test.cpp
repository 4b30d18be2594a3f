// Frame after frame: what is kept from the one before is what would be made again.
#include <algorithm>
#include <optional>

#include "core/error.h"
#include "geometry/shapes.h"
#include "support/drawing.h"
#include "support/gpu_fixture.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize(64, 48);

// A glass ball and a block over a floor, under a lamp, beside a basin of water under the sun.
Scene room() {
  Scene scene;
  scene.camera.position = {0, 3, 5};
  scene.environment.ambient = vec3(1);
  scene.materials.resize(2);
  scene.materials[1].type = MaterialType::dielectric;
  scene.meshes = {makePlane({8, 8}), makeSphere(0.5f, {.vertices = 700}), makeBox(vec3(0.6f))};
  scene.objects.resize(4);
  scene.objects[1] = {"ball", 1, 1, {vec3(0, 1, 0)}, std::nullopt};
  scene.objects[2] = {"block", 2, 0, {vec3(-1.5f, 0.4f, 0)}, std::nullopt};
  const Water water{{1.5f, 1.5f}, {12, 12}, {{0.02f, 0.5f, {1, 0}, 1, 0}}};
  scene.meshes.push_back(makeWater(water, 0));
  scene.objects[3] = {"water", 3, 1, {vec3(1.8f, 0.8f, 0)}, water};
  scene.lights.resize(2);
  scene.lights[0].position = {0.5f, 4, 0.5f};
  scene.lights[0].intensity = vec3(40);
  scene.lights[1].type = LightType::directional;
  scene.lights[1].direction = normalize(vec3(0.2f, -1, 0.1f));
  return scene;
}

class Frames : public GpuTest {
 protected:
  struct Kept : Drawing {
    Kept(const Scene& scene, const std::string& name, bool keepsLight)
        : Drawing(device(), scene, settingsOf(name),
                  {.size = kSize, .shadowMapSize = 256, .keepsLight = keepsLight}) {}
    std::vector<uint8_t> draw(const Scene& scene) {
      renderer.render(scene);
      return renderer.picture().bytes;
    }
  };
};

// One thing moves from each to the next.
std::vector<Scene> moved() {
  std::vector<Scene> scenes{room()};
  const auto next = [&]() -> Scene& { return scenes.emplace_back(scenes.back()); };
  next();
  next().camera.position.x += 0.3f;
  next().lights[0].intensity = vec3(60, 30, 20);
  next().lights[0].intensity = vec3(0);
  next().lights[0].intensity = vec3(30);
  next().lights[0].position.z -= 0.8f;
  next().lights[1].direction = normalize(vec3(-0.2f, -1, 0.1f));
  next().objects[2].placement = {vec3(-1, 0.6f, 0.2f), glm::angleAxis(1.0f, vec3(0, 1, 0)), 1.3f};
  next().objects[1].placement.translation.y += 0.3f;
  next().materials[0].color = vec3(0.3f, 0.5f, 0.7f);
  next().materials[1].ior = vec3(1.4f);
  Scene& waves = next();
  waves.meshes[3] = makeWater(*waves.objects[3].water, 0.2);
  next().environment.ambient = vec3(3, 2, 1);
  next().environment.background = vec3(1, 2, 3);
  next().camera.exposure = 2;
  next().camera.tone = ToneCurve::agx;
  next().camera.exposure.reset();
  next().camera.verticalFov = 30;
  return scenes;
}

// Between its frames of the scenes the second is shown another one, so that it makes all of them again.
TEST_F(Frames, ShowWhatMoves) {
  const std::vector<Scene> scenes = moved();
  Scene elsewhere = scenes[0];
  elsewhere.camera.position = {3, 2, 1};
  for (Object& object : elsewhere.objects) object.placement.translation += vec3(0.4f, 0.1f, 0.2f);
  for (const char* technique : {"adaptive-beams", "sliced-images"}) {
    Kept keeping(scenes[0], technique, true), making(scenes[0], technique, false);
    const bool isDefault = std::string(technique) == defaultTechnique();
    for (std::size_t i = 0; i < (isDefault ? scenes.size() : 4); ++i) {
      making.draw(elsewhere);
      EXPECT_EQ(keeping.draw(scenes[i]), making.draw(scenes[i])) << technique << ", frame " << i;
    }
    EXPECT_EQ(keeping.draw(scenes.back()), Kept(scenes.back(), technique, false).draw(scenes.back()))
        << technique;
  }
}

// A lamp before a wall, which shadows nothing, and then behind it.
TEST_F(Frames, ShowShadowsWhereThereWereNone) {
  Scene before = room();
  before.objects.resize(2);
  before.objects[1] = {"wall", 0, 0, {vec3(0, 1, -1), glm::angleAxis(1.57f, vec3(1, 0, 0))}, std::nullopt};
  before.lights.resize(1);
  before.lights[0].position = {0, 2, 1};
  Scene after = before;
  after.lights[0].position = {0, 2, -2.5f};
  Kept keeping(before, defaultTechnique(), true);
  keeping.draw(before);
  EXPECT_EQ(keeping.draw(after), Kept(after, defaultTechnique(), false).draw(after));
}

// What stands still takes no pass.
TEST_F(Frames, KeepWhatStandsStill) {
  const Scene scene = room();
  for (const bool keepsLight : {false, true}) {
    Kept drawing(scene, defaultTechnique(), keepsLight);
    const auto has = [](const std::vector<PassTime>& passes, const std::string& name) {
      return std::ranges::find(passes, name, &PassTime::name) != passes.end();
    };
    const std::vector<PassTime> first = drawing.renderer.render(scene),
                                second = drawing.renderer.render(scene);
    for (const char* pass : {"sight", "receivers", "shadow maps", "beams"})
      EXPECT_TRUE(has(first, pass)) << pass;
    for (const char* pass : {"sight", "receivers"}) EXPECT_FALSE(has(second, pass)) << pass;
    for (const char* pass : {"shadow maps", "beams"}) EXPECT_EQ(has(second, pass), !keepsLight) << pass;
    EXPECT_TRUE(has(second, "composite"));
  }
}

// What was canceled leaves the picture as it was, and nothing in the frame after it.
TEST_F(Frames, LeaveNothingBehindWhereTheyAreCanceled) {
  const std::vector<Scene> scenes = moved();
  const TechniqueSettings settings = settingsOf(defaultTechnique());
  Progress progress;
  Stats stats;
  SceneTransport transport(scenes[0], transportOf(settings), progress);
  const auto technique = makeTechnique({device(), settings, transport, stats, Casters::all, &progress});
  Renderer renderer(device(), transport, {.size = kSize, .shadowMapSize = 256, .keepsLight = true},
                    *technique);
  renderer.render(scenes[0]);
  const std::vector<uint8_t> before = renderer.picture().bytes;
  progress.cancel();
  EXPECT_THROW(renderer.render(scenes.back()), Interrupted);
  EXPECT_EQ(renderer.picture().bytes, before);
  progress.renew();
  renderer.render(scenes.back());
  EXPECT_EQ(renderer.picture().bytes, Kept(scenes.back(), defaultTechnique(), false).draw(scenes.back()));
}

}  // namespace
}  // namespace nephroid
