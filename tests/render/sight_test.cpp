// Rays of sight at a caster, before they are drawn.
#include <gtest/gtest.h>

#include "geometry/shapes.h"
#include "render/sight/view_rays.h"
#include "support/reference_scenes.h"
#include "transport/traced/traced_source.h"
#include "water/water.h"

namespace nephroid {
namespace {

// Cells as large as these are cut only where their rays part; what still water shows is as even as its bed.
TEST(Sight, ThroughWaterSeenFromNearbyIsNowhereThatOfOneRay) {
  Scene scene;
  Water water;
  water.size = {2, 2};
  water.grid = {120, 120};
  add(scene, makeWater(water, 0), glass());
  scene.objects.back().water = water;
  add(scene, makePlane({4, 4}), diffuse(0.5f), {0, -1, 0});
  scene.camera = {.position = {0.3f, 0.5f, 0.4f}, .target = {0, 0, 0}, .verticalFov = 30};
  const RayScene rays(scene);
  const TracedSource source(scene, rays);
  const View view = viewOf(scene.camera, {640, 480});
  const SightMesh mesh = sightMesh(scene, source, rays, sightQuery(0, view.eye, 0, {}), view);
  ASSERT_GT(mesh.indices.size(), 0u);
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const vec3 exit = mesh.vertices[mesh.indices[i]].exit;
    EXPECT_NE(exit, mesh.vertices[mesh.indices[i + 1]].exit);
    EXPECT_NE(exit, mesh.vertices[mesh.indices[i + 2]].exit);
  }
  // Twenty pixels a cell: no more than the two triangles of each.
  EXPECT_LE(mesh.indices.size(), 2u * 3 * 120 * 120);
}

}  // namespace
}  // namespace nephroid
