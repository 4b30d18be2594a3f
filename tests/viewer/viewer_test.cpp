// What hands do in the viewer, without a window.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <thread>

#include "core/error.h"
#include "formats/scene_toml.h"
#include "geometry/shapes.h"
#include "scene/framing.h"
#include "support/temporary_folder.h"
#include "viewer/camera_control.h"
#include "viewer/frame_times.h"
#include "viewer/picking.h"
#include "viewer/preferences.h"
#include "viewer/preparation.h"
#include "viewer/reference_worker.h"
#include "viewer/scene_lines.h"
#include "viewer/scene_state.h"

namespace nephroid {
namespace {

constexpr uvec2 kSize{640, 480};

Camera someCamera() {
  Camera camera;
  camera.position = {1, 2, 4};
  camera.target = {0.2f, 0.5f, 0};
  return camera;
}

TEST(CameraControl, OrbitGoesAroundTheTargetAndComesBack) {
  const Camera before = someCamera();
  Camera camera = before;
  orbit(camera, {0.4f, 0.3f});
  EXPECT_EQ(camera.target, before.target);
  EXPECT_NEAR(distance(camera.position, camera.target), distance(before.position, before.target), 1e-4);
  EXPECT_GT(camera.position.y, before.position.y);
  orbit(camera, {-0.4f, -0.3f});
  EXPECT_LT(distance(camera.position, before.position), 1e-4f);
}

// As a scene that is saved and loaded again would have it.
TEST(CameraControl, OrbitStandsUprightFromEveryHeight) {
  Camera camera = someCamera();
  for (const float turn : {10.0f, -20.0f}) {
    orbit(camera, {0, turn});
    EXPECT_EQ(camera.up, upFor(camera.target - camera.position));
  }
}

TEST(CameraControl, OrbitGoesOnFromStraightAbove) {
  Camera camera;
  camera.position = {0, 3, 0};
  camera.up = {0, 0, -1};
  orbit(camera, {0, -0.5f});
  EXPECT_NEAR(camera.position.x, 0, 1e-4f);
  EXPECT_GT(camera.position.z, 1);  // the lower edge of the picture comes nearer
}

TEST(CameraControl, LookTurnsTheViewTheWayThePointerGoes) {
  const Camera before = someCamera();
  Camera camera = before;
  look(camera, {0.1f, 0});
  EXPECT_EQ(camera.position, before.position);
  const vec3 right = cross(before.target - before.position, before.up);
  EXPECT_GT(dot(camera.target - before.target, right), 0);
  look(camera, {0, 0.1f});
  EXPECT_GT(camera.target.y, before.target.y);
}

TEST(CameraControl, PanTakesTheTargetWithThePointer) {
  Camera camera = someCamera();
  const vec3 held = camera.target;
  const vec2 before = *pixelOf(camera, kSize, held);
  pan(camera, {40, -25}, kSize.y);
  const vec2 after = *pixelOf(camera, kSize, held);
  EXPECT_LT(distance(after, before + vec2(40, -25)), 0.1f);
}

TEST(CameraControl, ZoomNeverReachesTheTarget) {
  Camera camera = someCamera();
  for (int i = 0; i < 20; ++i) zoom(camera, 1);
  EXPECT_GT(distance(camera.position, camera.target), 0);
  EXPECT_LT(distance(camera.position, camera.target), 0.4f);
}

TEST(CameraControl, AFramedBoxIsInThePicture) {
  Camera camera = someCamera();
  frameBox(camera, {{3, 3, 3}, {5, 4, 7}});
  for (const vec3 corner : {vec3(3, 3, 3), vec3(5, 4, 7), vec3(3, 4, 7), vec3(5, 3, 3)}) {
    const auto pixel = pixelOf(camera, kSize, corner);
    ASSERT_TRUE(pixel);
    EXPECT_TRUE(pixel->x > 0 && pixel->y > 0 && pixel->x < kSize.x && pixel->y < kSize.y);
  }
}

// A glass ball of radius 0.5 over a floor, a lamp of each kind.
Scene ballScene() {
  Scene scene;
  scene.camera = someCamera();
  scene.materials.resize(2);
  scene.materials[1].type = MaterialType::dielectric;
  scene.meshes = {makePlane({10, 10}, {}), makeSphere(0.5f, {16, 0})};
  scene.objects.resize(2);
  scene.objects[1].mesh = scene.objects[1].material = 1;
  scene.objects[1].placement.translation = {0, 0.8f, 0};
  for (const LightType type : {LightType::point, LightType::spot, LightType::line, LightType::directional}) {
    Light light;
    light.type = type;
    light.position = {static_cast<float>(scene.lights.size()) - 1.5f, 2.5f, 0};
    light.end = light.position + vec3(0, 0, 1);
    scene.lights.push_back(light);
  }
  return scene;
}

TEST(Picking, ARayGoesThroughItsPixel) {
  const Camera camera = someCamera();
  const vec3 point(0.3f, 0.7f, -1);
  const Ray ray = rayThrough(camera, kSize, *pixelOf(camera, kSize, point));
  EXPECT_LT(length(cross(ray.direction, point - ray.origin)), 1e-5f);
  EXPECT_FALSE(pixelOf(camera, kSize, camera.position + (camera.position - camera.target)));
}

TEST(Picking, FindsTheObjectInFrontAndTheLightOverIt) {
  const Scene scene = ballScene();
  const RayScene rays(scene);
  const auto at = [&](vec3 point) {
    return pick(scene, rays, kSize, *pixelOf(scene.camera, kSize, point), 10);
  };
  EXPECT_EQ(at({0, 0.8f, 0}), (Selection{Chosen::object, 1}));
  EXPECT_EQ(at({1.5f, 0, 1}), (Selection{Chosen::object, 0}));
  EXPECT_EQ(at(scene.lights[0].position), (Selection{Chosen::light, 0}));
  EXPECT_EQ(pick(scene, rays, kSize, {320, 2}, 10).what, Chosen::nothing);
}

TEST(Picking, WhatIsDraggedStaysUnderThePointer) {
  const Camera camera = someCamera();
  const vec3 anchor(0, 0.8f, 0);
  const vec2 from = *pixelOf(camera, kSize, anchor), to = from + vec2(60, 20);
  const vec3 onGround = draggedTo(camera, kSize, anchor, DragAlong::ground, from, to);
  EXPECT_NEAR(onGround.y, anchor.y, 1e-4f);
  EXPECT_LT(distance(*pixelOf(camera, kSize, onGround), to), 0.05f);
  const vec3 up = draggedTo(camera, kSize, anchor, DragAlong::y, from, from - vec2(0, 50));
  EXPECT_NEAR(up.x, anchor.x, 1e-5f);
  EXPECT_NEAR(up.z, anchor.z, 1e-5f);
  EXPECT_LT(distance(*pixelOf(camera, kSize, up), from - vec2(0, 50)), 2);
  const vec3 nowhere = draggedTo(camera, kSize, anchor, DragAlong::ground, from, {320, -5000});
  EXPECT_TRUE(glm::all(glm::lessThan(glm::abs(nowhere), vec3(1e4f))));
}

TEST(Picking, ALightFollowsItsHandle) {
  Scene scene = ballScene();
  for (const Handle& handle : handlesOf(scene)) {
    Scene moved = scene;
    const vec3 place = handle.position + vec3(0.3f, 0.4f, 0.5f);
    moveHandle(moved, handle, place);
    const auto handles = handlesOf(moved);
    const auto same = std::ranges::find_if(handles, [&](const Handle& other) {
      return other.light == handle.light && other.part == handle.part;
    });
    // What only points somewhere is held as far away as before.
    const bool isPointer =
        handle.part == HandlePart::aim || scene.lights[handle.light].type == LightType::directional;
    const float apart = distance(same->position, place);
    EXPECT_LT(apart, isPointer ? 0.6f : 1e-4f) << handle.light << " " << int(handle.part);
    EXPECT_NEAR(length(moved.lights[handle.light].direction), 1, 1e-5f);
  }
}

TEST(Picking, TurningKeepsTheCenter) {
  Scene scene = ballScene();
  Object& ball = scene.objects[1];
  const vec3 center = centerOf(scene, ball);
  turn(ball.placement, center, {0, 0, 1}, 0.5f);
  EXPECT_LT(distance(centerOf(scene, ball), center), 1e-4f);
  const float along = length(scene.lights[2].end - scene.lights[2].position);
  turn(scene.lights[2], {0, 1, 0}, 0.5f);
  EXPECT_NEAR(length(scene.lights[2].end - scene.lights[2].position), along, 1e-5f);
}

TEST(Histories, GoBackAndForth) {
  Scene scene = ballScene();
  History history(stateOf(scene));
  EXPECT_TRUE(history.isSaved());
  history.add(stateOf(scene));
  EXPECT_FALSE(history.canUndo());
  scene.lights[0].position.x = 9;
  history.add(stateOf(scene));
  scene.objects[1].placement.scale = 2;
  history.add(stateOf(scene));
  EXPECT_FALSE(history.isSaved());
  apply(history.undo(), scene);
  EXPECT_EQ(scene.objects[1].placement.scale, 1);
  EXPECT_EQ(scene.lights[0].position.x, 9);
  history.markSaved();
  EXPECT_TRUE(history.isSaved());
  EXPECT_EQ(history.redo().placements[1].scale, 2);
  EXPECT_FALSE(history.isSaved());
  history.undo();
  scene.materials[0].color = vec3(0.1f);
  history.add(stateOf(scene));
  EXPECT_FALSE(history.canRedo());
  apply(history.undo(), scene);
  apply(history.undo(), scene);
  EXPECT_EQ(stateOf(scene), stateOf(ballScene()));
  EXPECT_EQ(history.undo(), history.now());
}

TEST(SceneStates, TellWhatHasToBePreparedAnew) {
  Scene scene = ballScene();
  TechniqueSettings table, traced, volumes;
  table.transport.source = Source::table;
  traced.transport.source = Source::traced;
  volumes.technique = "irradiance-volume";
  const SceneState before = stateOf(scene);
  scene.lights[0].position.x = 9;
  scene.objects[1].placement.scale = 2;
  for (const TechniqueSettings& settings : {table, traced, volumes})
    EXPECT_FALSE(needsPreparation(before, stateOf(scene), settings));
  scene.materials[1].ior = vec3(1.7f);
  EXPECT_TRUE(needsPreparation(before, stateOf(scene), table));
  EXPECT_TRUE(needsPreparation(before, stateOf(scene), volumes));
  EXPECT_FALSE(needsPreparation(before, stateOf(scene), traced));
  scene.materials[0].emission = vec3(1);
  EXPECT_TRUE(needsPreparation(before, stateOf(scene), traced));
}

void waitFor(const Preparation& preparation) {
  while (!preparation.isDone()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
}

TEST(Preparations, GiveWhatDrawingNeeds) {
  PictureSettings settings;
  settings.technique.transport.source = Source::traced;
  Preparation preparation(ballScene, settings);
  waitFor(preparation);
  const std::unique_ptr<Prepared> made = preparation.take();
  EXPECT_EQ(made->scene.objects.size(), 2u);
  EXPECT_EQ(made->transport->scene().lights.size(), 4u);
}

TEST(Preparations, HandOnWhatWentWrong) {
  Preparation preparation([]() -> Scene { throw InputError("no such scene"); }, {});
  waitFor(preparation);
  EXPECT_THROW(preparation.take(), InputError);
}

TEST(Preparations, AreCanceled) {
  std::atomic<bool> isLoading = false, isCanceled = false;
  Preparation preparation(
      [&] {
        isLoading = true;
        while (!isCanceled) std::this_thread::yield();
        return ballScene();
      },
      {});
  while (!isLoading) std::this_thread::yield();
  EXPECT_EQ(preparation.progress().name, "Loading the scene");
  preparation.cancel();
  isCanceled = true;
  waitFor(preparation);
  EXPECT_THROW(preparation.take(), Interrupted);
}

TEST(FrameTimesShown, FollowSlowlyAndForgetPassesThatAreGone) {
  FrameTimes times;
  times.add(10, {{"a", 4}, {"b", 6}});
  EXPECT_EQ(times.milliseconds(), 10);
  times.add(20, {{"b", 16}});
  EXPECT_GT(times.milliseconds(), 10);
  EXPECT_LT(times.milliseconds(), 15);
  ASSERT_EQ(times.passes().size(), 1u);
  EXPECT_LT(times.passes()[0].milliseconds, 10);
  for (int i = 0; i < 100; ++i) times.add(20, {{"b", 16}});
  EXPECT_NEAR(times.milliseconds(), 20, 0.1);
}

TEST(Preferences, AreKeptAndForgivenWhenTheyCannotBeRead) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder / "nephroid" / "viewer.toml";
  EXPECT_EQ(loadPreferences(file).windowSize, ViewerPreferences{}.windowSize);
  savePreferences(file, {{900, 600}, false, true});
  const ViewerPreferences kept = loadPreferences(file);
  EXPECT_EQ(kept.windowSize, uvec2(900, 600));
  EXPECT_FALSE(kept.arePanelsShown);
  EXPECT_TRUE(kept.areTimesShown);
  std::ofstream(file) << "width = \"wide\"\nheight = -5\n[";
  EXPECT_EQ(loadPreferences(file).windowSize, ViewerPreferences{}.windowSize);
}

// What is looked at from elsewhere can be undone, and is no change that has to be saved; brightness is.
TEST(Histories, TakeTheCameraBack) {
  Scene scene = ballScene();
  History history(stateOf(scene));
  orbit(scene.camera, {0.5f, 0.1f});
  history.add(stateOf(scene));
  EXPECT_TRUE(history.isSaved());
  scene.camera.exposure = 2;
  history.add(stateOf(scene));
  EXPECT_FALSE(history.isSaved());
  history.undo();
  apply(history.undo(), scene);
  EXPECT_EQ(scene.camera, ballScene().camera);
}

TEST(SceneLines, BeamsLeaveTheBallAndSomeLightIsLost) {
  const Scene scene = ballScene();
  TechniqueSettings settings;
  settings.transport.source = Source::traced;
  Progress progress;
  SceneTransport transport(scene, transportOf(settings), progress);
  const std::vector<SceneLine> beams = beamLines(transport, Paths::transmission, 100);
  ASSERT_FALSE(beams.empty());
  EXPECT_LE(beams.size(), 300u);
  for (const SceneLine& line : beams) EXPECT_NEAR(distance(line.from, vec3(0, 0.8f, 0)), 0.5f, 0.02f);
  BeamCounts counts;
  culledLines(transport, Paths::transmission, 100, counts);
  EXPECT_GT(counts.carried, 0u);
  EXPECT_GT(counts.unlit, 0u);
  // From outside, all that enters a ball leaves it again; what grazes its facets may not.
  EXPECT_LT(counts.lost, counts.carried / 10);
}

TEST(SceneLines, OfALatticeAreItsEdgesAndTheCellsOfItsFaces) {
  const Lattice flat{LatticeKind::planes, vec3(0), {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0)}, uvec3(1)};
  EXPECT_EQ(latticeLines({&flat, 1}, LatticeKind::planes).size(), 4u);
  EXPECT_TRUE(latticeLines({&flat, 1}, LatticeKind::cells).empty());
  const Lattice box{LatticeKind::cells, vec3(0), {vec3(1, 0, 0), vec3(0, 1, 0), vec3(0, 0, 1)}, uvec3(1)};
  EXPECT_EQ(latticeLines({&box, 1}, LatticeKind::cells).size(), 12u);
}

// A picture that is 10 % too bright is 10 % off.
TEST(ErrorViews, TellHowFarOffAPictureIs) {
  Image reference, image;
  reference.width = reference.height = image.width = image.height = 4;
  for (const char* layer : {"", "caustics."})
    for (const char channel : {'R', 'G', 'B'}) {
      reference.channel(std::string(layer) + channel) = std::vector<float>(16, 2.0f);
      image.channel(std::string(layer) + channel) = std::vector<float>(16, 2.2f);
    }
  const ErrorView view = errorView(reference, image);
  EXPECT_NEAR(view.total.mape, 0.1, 1e-5);
  EXPECT_NEAR(view.caustics.fluxRatio, 1.1, 1e-5);
  EXPECT_GE(view.scaleEnd, 0.1);
  EXPECT_EQ(view.picture.bytes.size(), 48u);
}

TEST(ReferenceWorkers, RefineUntilTheyAreStopped) {
  Scene scene = ballScene();
  ReferenceSettings settings = referenceSettingsFor(Paths::transmission, {16, 12});
  settings.photons = 1000;
  ReferenceWorker worker;
  worker.start(scene, settings);
  const auto hasPasses = [&](uint32_t passes) {
    const auto view = worker.newest();
    return view && view->passes >= passes;
  };
  for (int i = 0; i < 20000 && !hasPasses(2); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ASSERT_TRUE(hasPasses(2));
  EXPECT_EQ(worker.newest()->picture.width, 16u);
  worker.stop();
  EXPECT_FALSE(worker.isRunning());
  EXPECT_EQ(worker.newest(), nullptr);
}

}  // namespace
}  // namespace nephroid
