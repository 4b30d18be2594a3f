// The table knows where it is too coarse.
#include "beams/source_error.h"

#include <gtest/gtest.h>

#include "geometry/mesh_checks.h"
#include "geometry/shapes.h"
#include "support/test_meshes.h"
#include "transport/scene_transport.h"

namespace nephroid {
namespace {

Scene ballUnderLamp(uint32_t vertices, float ior) {
  Scene scene;
  scene.materials.resize(2);
  scene.materials[1].type = MaterialType::dielectric;
  scene.materials[1].ior = vec3(ior);
  scene.meshes = {plane(5), makeSphere(0.5f, {.vertices = vertices})};
  scene.objects.resize(2);
  scene.objects[1].mesh = scene.objects[1].material = 1;
  scene.objects[1].placement.translation = {0, 0.7f, 0};
  scene.lights.emplace_back();
  scene.lights[0].position = {0.4f, 4, 0.2f};
  return scene;
}

double errorOfTable(const Scene& scene, uint32_t directions, Paths paths = Paths::transmission) {
  Progress progress;
  TransportSettings settings;
  settings.source = Source::table;
  settings.directions = directions;
  SceneTransport transport(scene, settings, progress);
  return sourceError(transport.scene(), transport.rayScene(), transport.source(), transport.traced(), paths);
}

TEST(SourceError, MoreDirectionsMakeItSmaller) {
  const Scene ball = ballUnderLamp(1500, 1.5f);
  const double coarse = errorOfTable(ball, 129), fine = errorOfTable(ball, 2049);
  EXPECT_GT(coarse, 0.1);
  EXPECT_LT(fine, 0.5 * coarse);
}

TEST(SourceError, VerticesFarApartLoseLight) {
  EXPECT_GT(errorOfTable(ballUnderLamp(60, 2.4f), 2049), errorOfTable(ballUnderLamp(1500, 2.4f), 2049));
}

// All paths are traced, table or not; what is between them is not.
TEST(SourceError, WhereRaysAreTracedOnlyTheLightBetweenThemIsWrong) {
  const Scene ball = ballUnderLamp(200, 1.5f);
  EXPECT_LT(errorOfTable(ball, 129, Paths::all), 0.5 * errorOfTable(ball, 129));
}

}  // namespace
}  // namespace nephroid
