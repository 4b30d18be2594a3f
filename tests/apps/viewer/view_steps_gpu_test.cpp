// What hands do in the window.
#include "apps/viewer/view_steps.h"

#include <algorithm>
#include <regex>
#include <span>

#include "formats/scene_toml.h"
#include "shown_views.h"
#include "support/stats.h"

namespace nephroid {
namespace {

std::size_t stonesIn(const ViewerState& state) {
  const auto& simulation = state.scene.objects.at(0).water->simulation;
  return simulation ? simulation->drops.size() : 0;
}

TEST_F(ViewSteps, AClickOnWaterDropsAStoneThatIsSavedWithTheScene) {
  const fs::path file = written("pool.toml", kPool);
  ASSERT_TRUE(opens(file));
  hands().click({40, 30});
  ASSERT_EQ(stonesIn(state()), 1u);
  EXPECT_TRUE(state().isPlaying);
  EXPECT_EQ(state().selection.what, Chosen::nothing);
  state().isPlaying = false;
  viewer().setTime(0.5);
  stepNow(viewer());
  const ByteImage moved = viewer().picture();
  hands().key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
  EXPECT_EQ(stonesIn(state()), 0u);
  EXPECT_GT(largestDifference(viewer().picture(), moved), 3u);
  hands().key(GLFW_KEY_Y, GLFW_MOD_CONTROL);
  EXPECT_EQ(stonesIn(state()), 1u);
  EXPECT_FALSE(viewer().isSaved());
  ASSERT_TRUE(viewer().save());
  EXPECT_TRUE(viewer().isSaved());
  EXPECT_LE(largestDifference(rendered(file, "0.5"), moved), 1u);
}

TEST_F(ViewSteps, EachDragOfTheCameraIsTakenBackByItself) {
  const fs::path file = written("ball.toml", kBallInView);
  state().settings.technique.technique = "none";
  ASSERT_TRUE(opens(file));
  const Camera first = state().scene.camera;
  hands().drag({70, 60}, {50, 55});
  const Camera second = state().scene.camera;
  hands().drag({70, 60}, {60, 65});
  const Camera third = state().scene.camera;
  for (int i = 0; i < 3; ++i) {
    hands().scroll(1);
    stepNow(viewer());
  }
  EXPECT_NE(state().scene.camera, third);
  EXPECT_TRUE(viewer().isSaved());
  for (const Camera& camera : {third, second, first, first}) {
    hands().key(GLFW_KEY_Z, GLFW_MOD_CONTROL);
    EXPECT_EQ(state().scene.camera, camera);
  }
}

// Of few vertices: finer shapes take long, and show no more of the viewer. Meshes of files stay as they are.
std::string coarse(const fs::path& scene) {
  const std::regex ofMesh("(mesh = .*(\\n[^\\[\\n].*)*?)\\nvertices = [0-9]+");
  const std::string text = std::regex_replace(readSceneFile(scene), ofMesh, "$1");
  const std::string few = std::regex_replace(text, std::regex("\\nvertices = [0-9]+"), "\nvertices = 600");
  return std::regex_replace(
      std::regex_replace(few, std::regex("\\ngrid = \\[[0-9, ]+\\]"), "\ngrid = [24, 24]"),
      std::regex("\\nsamples = [0-9]+"), "\nsamples = 2");
}

bool isOneColor(const ByteImage& picture) {
  const auto pixel = std::span(picture.bytes).first(picture.components);
  for (std::size_t i = 0; i < picture.bytes.size(); i += picture.components)
    if (!std::ranges::equal(std::span(picture.bytes).subspan(i, picture.components), pixel)) return false;
  return true;
}

// Stands for the bunny, which takes long to follow light through.
constexpr const char* kSmallBunny = R"(v -0.5 0 -0.5
v 0.5 0 -0.5
v 0 0 0.5
v 0 0.8 0
f 1 2 3
f 1 4 2
f 2 4 3
f 3 4 1
)";

// One after another in one window; all are saved, and some are rendered from what was saved.
TEST_F(ViewSteps, OpensEachSceneAndItsPictureFollowsTheLight) {
  const fs::path scenes = fs::path(NEPHROID_SOURCE_DIR) / "scenes";
  for (const char* name : {"polka-dots.png", "evening-sky.exr"}) fs::copy(scenes / name, folder_ / name);
  written("bunny.obj", kSmallBunny);
  const std::vector<std::string> saved{"glass-ball.toml", "knot-spotlight.toml", "water-drops.toml",
                                       "paper4-stage.toml"};
  std::size_t opened = 0;
  for (const auto& entry : fs::directory_iterator(scenes)) {
    if (entry.path().extension() != ".toml") continue;
    const std::string name = entry.path().filename().string();
    SCOPED_TRACE(name);
    const fs::path file = written(name, coarse(entry.path()));
    ASSERT_TRUE(opens(file));
    const ByteImage first = viewer().picture();
    EXPECT_FALSE(isOneColor(first));
    moveFirstLight(viewer());
    EXPECT_GT(largestDifference(viewer().picture(), first), 0u);
    EXPECT_FALSE(viewer().isSaved());
    ASSERT_TRUE(viewer().save()) << state().message.text;
    if (std::ranges::count(saved, name) > 0) {
      EXPECT_LE(largestDifference(viewer().picture(), rendered(file)), 1u);
    }
    ++opened;
  }
  EXPECT_GT(opened, 30u);
}

// A film in a window does not flicker: what is metered stays, whatever changes, until it is metered again.
TEST_F(ViewSteps, MetersWhenASceneIsOpenedAndWhenItIsAsked) {
  const std::string text = std::regex_replace(std::string(kBallInView), std::regex("exposure = 0.22\n"), "");
  const fs::path file = written("ball.toml", text);
  ASSERT_TRUE(opens(file));
  const std::optional<float> first = state().metered;
  ASSERT_TRUE(first);
  EXPECT_LE(largestDifference(viewer().picture(), rendered(file)), 1u);
  state().scene.lights[0].intensity *= 30.0f;
  stepNow(viewer());
  EXPECT_EQ(state().metered, first);
  const ByteImage bright = viewer().picture();
  hands().key(GLFW_KEY_G);
  ASSERT_TRUE(stepUntil([&] { return state().metered && state().metered != first; }));
  EXPECT_LT(*state().metered, 0.5f * *first);
  EXPECT_GT(largestDifference(viewer().picture(), bright), 20u);
  EXPECT_FALSE(state().scene.camera.exposure);
  // Given, it is the camera's own, and taken back it is metered anew.
  state().scene.camera.exposure = 0.22f;
  stepNow(viewer());
  EXPECT_FALSE(state().metered);
  ASSERT_TRUE(viewer().save());
  EXPECT_LE(largestDifference(viewer().picture(), rendered(file)), 1u);
  // Another scene is metered by itself.
  ASSERT_TRUE(opens(written("dark.toml", std::regex_replace(text, std::regex("= (20|1.2)\n"), "= 0.01\n"))));
  ASSERT_TRUE(state().metered);
  EXPECT_GT(*state().metered, 3 * *first);
}

// At rest samples come one in each frame until all are there, and none is kept when something changes.
TEST_F(ViewSteps, GathersSamplesAtRestAndForgetsThemWhenSomethingChanges) {
  const fs::path file = written("ball.toml", kBallInView);
  state().settings.samples.count = 20;
  ASSERT_TRUE(opens(file));
  moveFirstLight(viewer());
  EXPECT_EQ(state().gathered, 0u);
  EXPECT_GT(largestDifference(viewer().shownPicture(), viewer().picture()), 0u);
  for (uint32_t i = 1; i <= 20; ++i) {
    stepNow(viewer());
    EXPECT_EQ(state().gathered, i);
  }
  const ByteImage whole = viewer().shownPicture();
  for (int i = 0; i < 3; ++i) stepNow(viewer());
  EXPECT_EQ(state().gathered, 20u);
  EXPECT_EQ(viewer().shownPicture().bytes, whole.bytes);
  ASSERT_TRUE(viewer().save());
  EXPECT_LE(largestDifference(whole, rendered(file, "0", 20)), 1u);

  hands().drag({70, 60}, {50, 55});
  EXPECT_EQ(state().gathered, 0u);
  ASSERT_TRUE(stepUntil([&] { return state().gathered == 20; }));
  hands().key(GLFW_KEY_7);  // of a pass's output there is one sample
  for (int i = 0; i < 3; ++i) stepNow(viewer());
  hands().key(GLFW_KEY_0);
  state().settings.samples.count = 3;
  stepNow(viewer());
  EXPECT_EQ(state().gathered, 0u);
  ASSERT_TRUE(stepUntil([&] { return state().gathered == 3; }));
  state().settings.samples.count = 1;
  for (int i = 0; i < 3; ++i) stepNow(viewer());
  EXPECT_EQ(state().gathered, 0u);
}

TEST_F(ViewSteps, WhatIsDroppedIsOpenedOrAddedOrTheWindowSaysWhyNot) {
  state().settings.technique.technique = "none";
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
  hands().drop(written("picture.jpg", ""));
  stepNow(viewer());
  EXPECT_NE(state().message.text.find("what can be dropped"), std::string::npos);
  hands().drop(written("wrong.toml", "[camera\n"));
  ASSERT_TRUE(stepUntil([&] { return state().message.text.find("wrong.toml:1") != std::string::npos; }));
  EXPECT_EQ(state().scene.objects.size(), 2u);
  hands().drop(
      written("tent.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n"));
  ASSERT_TRUE(stepUntil([&] { return state().scene.objects.size() == 3; }));
  EXPECT_FALSE(viewer().isSaved());
  hands().drop(written("other.toml", kBallInView));
  stepNow(viewer());
  ASSERT_TRUE(state().question);
  state().question->answer = Question::Answer::cancel;
  stepNow(viewer());
  EXPECT_EQ(state().scene.objects.back().name, "tent");
}

// In the frame that takes it in.
TEST_F(ViewSteps, WhatAHandDoesIsSeenInTheNextFrame) {
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
  const vec2 from = *pixelOf(state().scene.camera, kSize, state().scene.lights[0].position);
  hands().moveTo(from);
  stepNow(viewer());
  hands().press();
  stepNow(viewer());
  for (int i = 1; i <= 5; ++i) {
    const ByteImage before = viewer().picture();
    hands().moveTo(from - vec2(5 * i, 0));
    int frames = 0;
    do {
      stepNow(viewer());
      ++frames;
    } while (viewer().picture().bytes == before.bytes && frames < 10);
    EXPECT_EQ(frames, 1);
  }
}

uint64_t sumOf(const Legend& legend) {
  uint64_t sum = 0;
  for (const Legend::Entry& entry : legend.entries) sum += entry.count;
  return sum;
}

// It has the beams of the frame that is seen, also while the light moves.
TEST_F(ViewSteps, TheMeshOfRaysFollowsTheLight) {
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
  EXPECT_TRUE(state().meshLegend.entries.empty());
  hands().key(GLFW_KEY_1);
  const uint64_t before = countIn(state().stats, "beams");
  EXPECT_EQ(sumOf(state().meshLegend), before);
  moveFirstLight(viewer());
  EXPECT_NE(countIn(state().stats, "beams"), before);
  EXPECT_EQ(sumOf(state().meshLegend), countIn(state().stats, "beams"));
  hands().key(GLFW_KEY_1);
  EXPECT_TRUE(state().meshLegend.entries.empty());
}

TEST_F(ViewSteps, LevelsOfLandedLightAreShownAndPutAway) {
  ASSERT_TRUE(opens(written("ball.toml", kBallInView)));
  hands().key(GLFW_KEY_C);
  EXPECT_EQ(state().shown, Shown::output);
  const uint64_t cells = sumOf(state().outputLegend);
  EXPECT_GT(cells, 0u);
  moveFirstLight(viewer());
  EXPECT_NE(sumOf(state().outputLegend), cells);
  hands().key(GLFW_KEY_C);
  EXPECT_EQ(state().shown, Shown::picture);
  state().settings.technique.technique = "light-volumes";
  ASSERT_TRUE(stepUntil([&] { return !outputOf(state(), "landed light", "levels"); }));
  hands().key(GLFW_KEY_C);
  EXPECT_EQ(state().shown, Shown::picture);
}

}  // namespace
}  // namespace nephroid
