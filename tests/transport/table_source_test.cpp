// The light transport table as a source of beams: what its numbers of bits do to an image, and what it costs
// to move things.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#define GLM_ENABLE_EXPERIMENTAL
#include <glm/gtx/quaternion.hpp>

#include "beams/build.h"
#include "beams/plane_plan.h"
#include "lights/emitters.h"
#include "render/measure.h"
#include "support/ball_over_floor.h"
#include "support/quantized_source.h"
#include "transport/queries.h"
#include "transport/table/entry.h"
#include "transport/table/table_source.h"
#include "transport/traced/traced_source.h"

namespace nephroid {
namespace {

const Sensor kFloor{"floor", {-2, 0, -0.75f}, {1.5f, 0, 0}, {0, 0, 1.5f}, {128, 128}};

TEST(TableSource, ItsBitsChangeTheImageByLessThanOnePercent) {
  const Scene scene = ballOverFloor(1, {3, 3.5f, 0});
  const RayScene rays(scene);
  const TracedSource traced(scene, rays);
  Progress progress;
  Stats stats;
  const auto read = [&](bool isExact) {
    const QuantizedSource source(scene, traced, isExact);
    return measureBeams(scene, rays, source, kFloor, Paths::transmission, 0, progress, stats);
  };
  const SensorLayer exact = read(true), coarse = read(false);
  double peak = 0, largest = 0, squares = 0, sum = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const double difference = double(coarse[i].y) - double(exact[i].y);
    peak = std::max(peak, double(exact[i].y));
    largest = std::max(largest, std::abs(difference));
    squares += difference * difference;
    sum += double(exact[i].y);
  }
  const double mean = sum / double(exact.size());
  RecordProperty("largest_of_peak", std::to_string(largest / peak));
  RecordProperty("rmse_of_mean", std::to_string(std::sqrt(squares / double(exact.size())) / mean));
  EXPECT_LT(largest / peak, 0.01);
  EXPECT_LT(std::sqrt(squares / double(exact.size())) / mean, 0.01);
}

TEST(TableSource, MotionOfCasterReceiverAndLightTracesNoRay) {
  Scene scene = ballOverFloor(1, {3, 3.5f, 0});
  RayScene rays(scene);
  const TracedSource traced(scene, rays);
  Progress progress;
  std::vector<std::optional<TransportTable>> tables(2);
  tables[0] = buildTable(scene.meshes[0], vec3(1.5f), {.directions = 33}, progress);
  const TableSource source(scene, std::move(tables), traced);
  const uint64_t before = raysTraced();
  for (int step = 0; step < 5; ++step) {
    Placement& ball = scene.objects[0].placement;
    ball.translation += vec3(0.1f, 0.05f, -0.07f);
    ball.rotation = glm::angleAxis(0.3f * float(step), normalize(vec3(1, 2, 3)));
    scene.objects[1].placement.translation.y -= 0.1f;
    scene.lights[0].position += vec3(-0.4f, 0.1f, 0.3f);
    rays.place(scene);
    const Emitter emitter = emittersOf(scene)[0];
    const auto queries = queriesFor(scene, 0, emitter, traced.mediaAround(emitter), Paths::transmission);
    const BeamSet set =
        buildBeams(scene, source, queries[0].query, queries[0].bandColor, {.refineDepth = 0, .targets = {}});
    EXPECT_GT(set.beams.size(), 1000u);
    const std::vector<ReceiverBox> boxes = receiverBoxes(scene);
    EXPECT_EQ(planAlongLight(portionsByAxis(set.beams, boxes).front(), boxes, 4, 512).planes, 4u);
  }
  EXPECT_EQ(raysTraced(), before);
}

// A table knows smooth glass by itself.
TEST(Tables, AreOfNoWaterNorFacetsNorWhatHoldsAnother) {
  Scene scene = ballOverFloor(1, {3, 3.5f, 0});
  EXPECT_TRUE(hasTable(scene, scene.objects[0]));
  EXPECT_FALSE(hasTable(scene, scene.objects[1]));
  Scene box = scene;
  box.meshes[0] = makeBox({1, 1, 1});
  EXPECT_FALSE(hasTable(box, box.objects[0]));
  box.meshes[0] = makeCylinder(0.3f, 1);
  EXPECT_FALSE(hasTable(box, box.objects[0]));
  Scene water = scene;
  water.objects[0].water = Water{};
  EXPECT_FALSE(hasTable(water, water.objects[0]));
  Scene nested = scene;
  nested.objects.push_back(scene.objects[0]);
  nested.objects[2].placement.scale = 0.5f;
  EXPECT_FALSE(hasTable(nested, nested.objects[0]));
  EXPECT_TRUE(hasTable(nested, nested.objects[2]));
}

// Of the light of the first emitter that meets an object's vertices and is not lost: lm or lux, for a
// comparison of sources.
struct VertexLight {
  uint32_t lit = 0;
  vec3 direction{0};
  float transmittance = 0;
};

VertexLight vertexLight(const Scene& scene, const TransportSource& source, uint32_t object) {
  TransportQuery query;
  query.object = object;
  query.emitter = emittersOf(scene)[0];
  std::vector<OutgoingRay> rays(scene.meshOf(scene.objects[object]).positions.size());
  source.vertexRays(query, rays);
  VertexLight sum;
  for (const OutgoingRay& ray : rays) {
    if (ray.flags != 0) continue;
    ++sum.lit;
    sum.direction += ray.direction;
    sum.transmittance += ray.transmittance.y;
  }
  return sum;
}

// A second ball stands behind the first, in the light, and then a plate before both.
TEST(TableSource, LightGoesOnThroughOtherCastersAndStopsAtWhatStandsBefore) {
  Scene scene = ballOverFloor(1, {3, 3.5f, 0});
  scene.meshes[0] = makeSphere(0.5f, {.vertices = 1600});
  scene.objects[1].placement.translation.y = -2;
  Object second = scene.objects[0];
  const vec3 light = scene.lights[0].position;
  const vec3 away = normalize(scene.objects[0].placement.translation - light);
  second.placement.translation += 1.2f * away + vec3(0, 0, 0.5f);
  second.name = "second";
  scene.objects.push_back(second);
  const auto compare = [&](bool isDark) {
    const RayScene rays(scene);
    const TracedSource traced(scene, rays);
    Progress progress;
    std::vector<std::optional<TransportTable>> tables(scene.objects.size());
    tables[0] = tables[2] = buildTable(scene.meshes[0], vec3(1.5f), {.directions = 513}, progress);
    const TableSource table(scene, std::move(tables), traced);
    for (const uint32_t object : {0u, 2u}) {
      const VertexLight looked = vertexLight(scene, table, object);
      const VertexLight exact = vertexLight(scene, traced, object);
      if (isDark) {
        EXPECT_EQ(looked.lit, 0u);
        continue;
      }
      // Rims, where a vertex or two may fall on either side, are one part in thirty of the lit ones.
      EXPECT_NEAR(looked.lit, exact.lit, std::max(0.03 * exact.lit, 3.0)) << object;
      EXPECT_NEAR(looked.transmittance, exact.transmittance, 0.03f * exact.transmittance + 3) << object;
      EXPECT_GT(dot(normalize(looked.direction), normalize(exact.direction)), 0.999f) << object;
    }
  };
  compare(false);
  scene.meshes.push_back(makePlane({1, 1}));
  scene.objects.push_back({"plate", 2, scene.objects[1].material, {}, std::nullopt});
  Placement& plate = scene.objects.back().placement;
  plate.translation = light + 0.3f * away;
  plate.rotation = glm::rotation(vec3(0, 1, 0), -away);
  compare(true);
}

}  // namespace
}  // namespace nephroid
