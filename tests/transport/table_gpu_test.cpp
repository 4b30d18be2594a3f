#include <algorithm>

#include "core/random.h"
#include "gpu/command_list.h"
#include "gpu/transfer.h"
#include "shaders/tests/transport/table_comp.h"
#include "support/gpu_fixture.h"
#include "support/table_meshes.h"
#include "transport/table/table.h"

namespace nephroid {
namespace {

static_assert(sizeof(TableLayout) == 60);
static_assert(sizeof(OutgoingRay) == 52);

struct TableConstants {
  uint64_t words, layouts, directions, rays;
  uint32_t count;
};

using TableGpuTest = GpuTest;

TEST_F(TableGpuTest, ShadersLookUpAsTheHostDoes) {
  Mesh mesh = ballMesh(8);
  addBall(mesh, vec3(0, 2.1f, 0), 1, 8);
  Progress progress;
  const TransportTable table = buildTable(mesh, vec3(1.4f, 1.5f, 1.6f), {}, progress);
  Random random(4);
  std::vector<vec3> directions(20000);
  for (vec3& direction : directions) {
    do {
      direction = 2.0f * vec3(random.uniform(), random.uniform(), random.uniform()) - 1.0f;
    } while (length(direction) < 0.1f || direction.z > 0);
    direction = normalize(direction);
  }
  const auto count = static_cast<uint32_t>(directions.size());

  const gpu::Program program =
      gpu::createComputeProgram(device(), "table", shaders::tests_transport_table_comp);
  const gpu::Buffer words =
      gpu::upload(device(), "words", std::vector<uint32_t>(table.words().begin(), table.words().end()));
  const gpu::Buffer layouts = gpu::upload(device(), "layout", std::vector<TableLayout>{table.view()});
  const gpu::Buffer from = gpu::upload(device(), "directions", directions);
  const gpu::Buffer to = gpu::createBuffer(device(), "rays", count * sizeof(OutgoingRay));
  device().submitAndWait([&](gpu::CommandList& commands) {
    commands.dispatch(
        program, {count, 1, 1},
        TableConstants{words.address(), layouts.address(), from.address(), to.address(), count});
  });
  const auto rays = gpu::download<OutgoingRay>(device(), to);

  uint32_t otherWay = 0;
  for (uint32_t i = 0; i < count; ++i) {
    const uint32_t vertex = i % static_cast<uint32_t>(mesh.positions.size());
    const OutgoingRay expected = lookUp(table, vertex, directions[i], i % 3);
    if (rays[i].signature != expected.signature) {
      ++otherWay;
      continue;
    }
    // Angles from a driver's atan are good to some 4096 units in the last place (Vulkan's table of
    // precisions).
    EXPECT_EQ(rays[i].flags, expected.flags);
    EXPECT_LT(length(rays[i].position - expected.position), 5e-3) << i;
    EXPECT_LT(length(rays[i].direction - expected.direction), 5e-3) << i;
    EXPECT_NEAR(rays[i].pathLength, expected.pathLength, 5e-3) << i;
    EXPECT_NEAR(rays[i].transmittance.y, expected.transmittance.y, 2e-3) << i;
  }
  // Only where two ways weigh the same to the last digits may the two choose differently.
  EXPECT_LE(otherWay, count / 500);
}

}  // namespace
}  // namespace nephroid
