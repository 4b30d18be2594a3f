// Under a sky that is equally bright all around, whatever absorbs nothing cannot be seen.
#include <gtest/gtest.h>

#include <algorithm>

#include "support/reference_scenes.h"

namespace nephroid {
namespace {

constexpr vec3 kSky{1, 2, 3};  // nit

ReferenceSettings oneRayPerPixel() {
  ReferenceSettings settings;
  settings.size = {128, 96};
  settings.photons = 1;
  return settings;
}

// Rays that leave a face so close to an edge that the next face is within the margin for self-intersection
// miss it, where margin and edge are a thousandth of each other at most; `astray`: as many pixels.
constexpr double kAstray = 1e-3;

void expectAllAround(Scene& scene, float times = 1, double astray = 0) {
  scene.environment.background = kSky;
  const Image image = seen(scene, 4, oneRayPerPixel());
  for (int c = 0; c < 3; ++c) {
    const std::vector<float>& nits = *image.find(std::string(1, "RGB"[c]));
    // Two factors for each face that is crossed, each rounded to 6e-8; most rays cross fewer than twenty.
    const auto isOff = [&](float value) { return std::abs(value / (times * kSky[c]) - 1) > 4e-6f; };
    EXPECT_LE(double(std::ranges::count_if(nits, isOff)), 4 * astray * double(nits.size()));
  }
}

// Seen as large as the picture.
Scene lookingAtTheOrigin(float distance) {
  Scene scene;
  scene.camera.position = distance * normalize(vec3(0.3f, 0.5f, 1));
  scene.camera.verticalFov = 2 * glm::degrees(std::atan(1 / distance));
  return scene;
}

// Triangles that are as flat as those of a scan, with normals that belong to something smooth.
Mesh bumpyBall() {
  Mesh mesh = makeSphere(1, {.vertices = 642});
  mesh.isCurved = false;
  for (vec3& p : mesh.positions)
    p *= 0.8f + 0.12f * std::sin(7 * p.x) * std::sin(5 * p.y + 1) * std::sin(6 * p.z);
  for (vec3& normal : mesh.normals) normal = vec3(0);
  for (const uvec3& t : mesh.triangles) {
    const vec3& a = mesh.positions[t.x];
    const vec3 area = cross(mesh.positions[t.y] - a, mesh.positions[t.z] - a);
    for (int corner = 0; corner < 3; ++corner) mesh.normals[t[corner]] += area;
  }
  for (vec3& normal : mesh.normals) normal = normalize(normal);
  return mesh;
}

TEST(WhiteFurnace, HidesClearGlassOfAnyShape) {
  for (Mesh& mesh : std::vector<Mesh>{makeSphere(1), makeBox({1, 1.2f, 0.8f}), makeTorus(0.6f, 0.3f),
                                      makeTorusKnot(2, 3, 0.6f, 0.2f), bumpyBall()}) {
    Scene scene = lookingAtTheOrigin(4);
    add(scene, std::move(mesh), glass());
    expectAllAround(scene, 1, kAstray);
  }
}

TEST(WhiteFurnace, HidesGlassOfOtherIndices) {
  for (const float ior : {1.0f, 1.1f, 2.4f}) {
    Scene scene = lookingAtTheOrigin(4);
    add(scene, makeSphere(1), glass(ior));
    expectAllAround(scene, 1, kAstray);
  }
}

TEST(WhiteFurnace, HidesMirrorsAndThinGlass) {
  Scene scene = lookingAtTheOrigin(4);
  add(scene, makeTorus(0.6f, 0.3f), mirror());
  Material pane = glass();
  pane.thinWalled = true;
  add(scene, makeBox({0.5f, 0.5f, 0.5f}), pane);
  expectAllAround(scene, 1, kAstray);
}

TEST(WhiteFurnace, HidesABubbleInABallInWater) {
  Scene scene = lookingAtTheOrigin(5);
  add(scene, makeSphere(0.5f), glass(1));
  add(scene, makeSphere(0.8f), glass(1.5f));
  add(scene, makeBox({2.2f, 2.2f, 2.2f}), glass(1.33f));
  expectAllAround(scene, 1, kAstray);
}

TEST(WhiteFurnace, HidesGlassThatReachesIntoGlass) {
  Scene scene = lookingAtTheOrigin(4);
  add(scene, makeSphere(0.6f), glass(1.5f), {-0.3f, 0, 0});
  add(scene, makeSphere(0.5f), glass(1.8f), {0.3f, 0, 0});
  expectAllAround(scene, 1, kAstray);
}

TEST(WhiteFurnace, LosesToTheColorOfAMirrorAlone) {
  Scene scene = lookingAtTheOrigin(4);
  add(scene, makeBox({10, 10, 0.1f}), mirror(0.25f));
  scene.camera.position = {0, 0, 4};
  expectAllAround(scene, 0.25f);
}

// Radiance over the square of the index is what a boundary keeps.
TEST(WhiteFurnace, IsBrighterByTheSquareOfTheIndexFromWithinGlass) {
  // Within the critical angle of the face ahead, and so of the one behind.
  Scene block;
  block.camera.position = {0.1f, 0.2f, 0};
  block.camera.target = {0.1f, 0.2f, 1};
  add(block, makeBox({2, 2, 2}), glass(1.5f));
  expectAllAround(block, 1.5f * 1.5f, kAstray);

  Scene ball;
  ball.camera.position = {0.2f, 0.1f, 0};
  ball.camera.target = {0, 0, 1};
  ball.camera.verticalFov = 90;
  add(ball, makeSphere(1), glass(1.33f));
  expectAllAround(ball, 1.33f * 1.33f);

  // Air in glass is as bright as air.
  add(ball, makeSphere(0.3f), glass(1));
  expectAllAround(ball);
}

}  // namespace
}  // namespace nephroid
