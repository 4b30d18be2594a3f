// Lamps that lie on the surface of a caster.
#include "beams/ray_mesh/lamp_on_surface.h"

#include <gtest/gtest.h>

#include "beams/ray_mesh/ray_mesh.h"
#include "support/ball_over_floor.h"

namespace nephroid {
namespace {

constexpr float kHeight = 0.8f, kRadius = 0.5f;  // m, of ballOverFloor

TEST(LampOnSurface, IsTakenToBeAHairOutside) {
  const Scene scene = ballOverFloor(kHeight, {0, 3, 0});
  const RayScene rays(scene);
  const vec3 middle(0, kHeight, 0);
  for (const vec3 direction : {vec3(0, 1, 0), normalize(vec3(1, 2, -2)), normalize(vec3(-3, 1, 1))}) {
    const vec3 moved = besideSurfaces(scene, rays, middle + kRadius * direction);
    EXPECT_GT(distance(moved, middle), kRadius);
    EXPECT_LT(distance(moved, middle), 1.01f * kRadius);
    EXPECT_GT(dot(normalize(moved - middle), direction), 0.999f);
    for (const float part : {0.9f, 0.99f, 1.01f, 2.0f}) {
      const vec3 off = middle + part * kRadius * direction;
      EXPECT_EQ(besideSurfaces(scene, rays, off), off);
    }
  }
}

// The floor is as bright as where the lamp is a little farther off.
TEST(LampOnSurface, LightsWhatIsBehindTheGlass) {
  const auto landed = [](vec3 lamp) {
    const Scene scene = ballOverFloor(kHeight, lamp);
    const RayScene rays(scene);
    Progress progress;
    RayMesh mesh;
    RayMeshSettings settings;
    settings.detail = 0.005f;
    traceRayMesh(scene, rays, settings, progress, mesh);
    return mesh.stats.landedFlux;
  };
  for (const vec3 direction : {vec3(0, 1, 0), normalize(vec3(1, 2, -2))}) {
    const vec3 middle(0, kHeight, 0);
    const double near = landed(middle + 1.0005f * kRadius * direction);
    EXPECT_GT(near, 0);
    EXPECT_NEAR(landed(middle + kRadius * direction) / near, 1, 0.03);
  }
}

}  // namespace
}  // namespace nephroid
