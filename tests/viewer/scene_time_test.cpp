// What moves by itself in the viewer.
#include <gtest/gtest.h>

#include "core/image_io.h"
#include "formats/load.h"
#include "formats/scene_toml.h"
#include "support/scratch_files.h"
#include "viewer/scene_state.h"
#include "viewer/scene_time.h"

namespace nephroid {
namespace {

// A spot that swings and dims, and waves.
constexpr const char* kMoving = R"([camera]
position = [0, 1, 3]
[[light]]
type = "spot"
position = [0, 3, 0]
target = [0, 0, 0.5]
intensity = 10
dimmer = [[0, 1], [2, 0.5]]
pan = [[0, 0], [2, 90]]
[[material]]
name = "water"
type = "dielectric"
[[object]]
shape = "water"
material = "water"
grid = [8, 8]
waves = [{ amplitude = 0.1, wavelength = 1, speed = 0.3 }]
)";

class SceneTimeFiles : public ScratchFiles {};

TEST(SceneTimes, MoveWhatMovesByItselfAsLoadingThenWould) {
  Scene scene = readTomlScene(kMoving, "scene.toml", 0);
  SceneState asLoaded = stateOf(scene);
  History history(asLoaded);
  WaveRuns waves;
  moveTo(scene, asLoaded, history, kMoving, 1, waves);
  const Scene then = readTomlScene(kMoving, "scene.toml", 1);
  EXPECT_EQ(stateOf(scene), stateOf(then));
  EXPECT_EQ(asLoaded, stateOf(then));
  EXPECT_EQ(history.now(), stateOf(then));
  EXPECT_TRUE(history.isSaved());
  EXPECT_EQ(scene.meshes[0].positions, then.meshes[0].positions);
}

// A frame is no time to read files in.
TEST_F(SceneTimeFiles, AreReadOnce) {
  writePng(folder() / "gobo.png", {2, 2, 3, std::vector<uint8_t>(12, 200)});
  const std::string text =
      "[[light]]\ntype = \"spot\"\nposition = [0, 2, 0]\ndirection = [0, -1, 0]\nintensity = 1\n"
      "gobo = \"gobo.png\"\npan = [[0, 0], [2, 90]]\n"
      "[[light]]\ntype = \"sky\"\nluminance = 3\nrotation = [[0, 0], [2, 90]]\n";
  Scene scene = loadScene(write("scene.toml", text), 0);
  const Scene then = loadScene(folder() / "scene.toml", 1);
  std::filesystem::remove(folder() / "gobo.png");
  SceneState asLoaded = stateOf(scene);
  History history(asLoaded);
  WaveRuns waves;
  moveTo(scene, asLoaded, history, text, 1, waves);
  EXPECT_EQ(stateOf(scene), stateOf(then));
  EXPECT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].texels, then.textures[0].texels);
  EXPECT_EQ(scene.skies.size(), 1u);
}

TEST(SceneTimes, LeaveWhatHandsChanged) {
  Scene scene = readTomlScene(kMoving, "scene.toml", 0);
  SceneState asLoaded = stateOf(scene);
  scene.lights[0].direction = {1, 0, 0};
  scene.lights[0].position = {5, 5, 5};
  scene.lights[0].intensity *= 2;
  History history(asLoaded);
  history.add(stateOf(scene));
  WaveRuns waves;
  moveTo(scene, asLoaded, history, kMoving, 2, waves);
  EXPECT_EQ(scene.lights[0].direction, vec3(1, 0, 0));
  EXPECT_EQ(scene.lights[0].position, vec3(5, 5, 5));
  EXPECT_NEAR(scene.lights[0].intensity.x, 10, 1e-4f);
  EXPECT_EQ(history.now(), stateOf(scene));
  EXPECT_FALSE(history.isSaved());
  EXPECT_EQ(history.undo(), asLoaded);
  EXPECT_TRUE(history.isSaved());
}

TEST(Stones, FallIntoWaterAndAreTakenBack) {
  Scene scene = readTomlScene(kMoving, "scene.toml", 0);
  const std::vector<vec3> still = scene.meshes[0].positions;
  History history(stateOf(scene));
  ASSERT_TRUE(takesStones(scene.objects[0]));
  dropStone(scene, 0, {0.1f, 0.2f});
  history.add(stateOf(scene));
  EXPECT_FALSE(history.isSaved());
  SceneState asLoaded = stateOf(readTomlScene(kMoving, "scene.toml", 0));
  WaveRuns waves;
  moveTo(scene, asLoaded, history, kMoving, 0.5, waves);
  const std::vector<vec3> moved = scene.meshes[0].positions;
  apply(history.undo(), scene);
  EXPECT_EQ(scene.meshes[0].positions, readTomlScene(kMoving, "scene.toml", 0.5).meshes[0].positions);
  EXPECT_NE(scene.meshes[0].positions, moved);
  apply(history.redo(), scene);
  EXPECT_EQ(scene.meshes[0].positions, moved);
  EXPECT_NE(still, moved);
}

}  // namespace
}  // namespace nephroid
