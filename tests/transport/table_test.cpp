#include "transport/table/table.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/error.h"
#include "core/random.h"
#include "support/table_meshes.h"
#include "trace/ray_scene.h"
#include "transport/table/fill.h"
#include "transport/table/table_source.h"

namespace nephroid {
namespace {

constexpr float kIor = 1.5f;
constexpr float kHalfStep = 0.5f / 65535;

// A table of the ball's closed form instead of traced rays.
TransportTable exactBallTable(const Mesh& ball, uint32_t directions) {
  Progress progress;
  const auto trace = [&](uint32_t vertex, float ior, std::span<const vec3> incident,
                         std::span<OutgoingRay> rays) {
    for (std::size_t i = 0; i < incident.size(); ++i)
      rays[i] = rayThroughBall(ball.positions[vertex], incident[i], 1, ior);
  };
  return fillTable(tableKey(ball, vec3(kIor), {directions}), ball, trace, progress);
}

TransportTable tracedTable(const Mesh& mesh, uint32_t directions = 129, vec3 ior = vec3(kIor)) {
  Progress progress;
  return buildTable(mesh, ior, {directions}, progress);
}

// Distributed as the flux of even light over a surface: by the cosine to the normal.
vec3 randomIncidence(Random& random) {
  const float azimuth = 2 * kPi * random.uniform();
  const float sine = std::sqrt(random.uniform());
  return {sine * std::cos(azimuth), sine * std::sin(azimuth), -std::sqrt(1 - sine * sine)};
}

float angleBetween(vec3 a, vec3 b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

struct BallError {
  double position = 0;   // RMS, of the radius
  double direction = 0;  // RMS, radians
  double flux = 0;       // looked up over exact
};

BallError errorOf(const TransportTable& table, const Mesh& ball) {
  constexpr int kSamples = 20000;
  Random random(7);
  BallError error;
  double exactFlux = 0;
  for (int i = 0; i < kSamples; ++i) {
    const uint32_t vertex = random.next() % static_cast<uint32_t>(ball.positions.size());
    const vec3 local = randomIncidence(random);
    const vec3 incident = vertexFrame(ball.normals[vertex]) * local;
    const OutgoingRay exact = rayThroughBall(ball.positions[vertex], incident, 1, kIor);
    const OutgoingRay found = lookUp(table, vertex, local);
    error.position += std::pow(length(found.position - exact.position), 2) / kSamples;
    error.direction += std::pow(angleBetween(found.direction, exact.direction), 2) / kSamples;
    error.flux += found.flags ? 0 : found.transmittance.x;
    exactFlux += exact.transmittance.x;
  }
  error.position = std::sqrt(error.position);
  error.direction = std::sqrt(error.direction);
  error.flux /= exactFlux;
  return error;
}

TEST(TableDirections, AreAPoleAndRings) {
  const Mesh ball = ballMesh(4);
  EXPECT_EQ(tableKey(ball, vec3(kIor), {129}).rings, 8u);
  EXPECT_EQ(tableKey(ball, vec3(kIor), {129}).azimuths, 16u);
  for (const uint32_t directions : {9u, 129u, 513u, 2049u})
    EXPECT_EQ(tableKey(ball, vec3(kIor), {directions}).directions(), directions);
  EXPECT_EQ(tableKey(ball, vec3(kIor), {150}).directions(), 163u);  // 1 + 9 x 18 is nearer than 1 + 8 x 16
}

TEST(TableDirections, ThatCannotBeAreRejected) {
  const Mesh ball = ballMesh(40);
  EXPECT_THROW(tableKey(ball, vec3(kIor), {0}), InputError);
  EXPECT_THROW(tableKey(ball, vec3(kIor), {8}), InputError);
  EXPECT_THROW(tableKey(ball, vec3(kIor), {4000000000u}), InputError);
  EXPECT_THROW(tableKey(ball, vec3(kIor), {2000000u}), InputError);  // 3321 vertices: 25 GB
}

TEST(TableDirections, ComeFromOutsideAndAreTheirOwnCell) {
  for (uint32_t i = 0; i < 129; ++i) {
    const vec3 direction = sampledDirection(i, 8, 16);
    EXPECT_NEAR(length(direction), 1, 1e-6);
    EXPECT_LT(direction.z, 0);
    const DirectionCell cell = cellAround(direction, 8, 16);
    float own = 0;
    for (int corner = 0; corner < 4; ++corner) own += cell.direction[corner] == i ? cell.weight[corner] : 0;
    EXPECT_NEAR(own, 1, 1e-5) << i;
  }
}

TEST(TableDirections, CellsSurroundTheirDirection) {
  Random random(3);
  for (int i = 0; i < 10000; ++i) {
    const vec3 direction = randomIncidence(random);
    const DirectionCell cell = cellAround(direction, 8, 16);
    vec3 mean(0);
    float sum = 0;
    for (int corner = 0; corner < 4; ++corner) {
      ASSERT_LT(cell.direction[corner], 129u);
      ASSERT_GE(cell.weight[corner], 0);
      sum += cell.weight[corner];
      mean += cell.weight[corner] * sampledDirection(cell.direction[corner], 8, 16);
    }
    ASSERT_NEAR(sum, 1, 1e-5);
    // A cell is 10.9 by 22.5 degrees; the outermost ring stands in for the last 3.
    ASSERT_LT(angleBetween(mean, direction), glm::radians(3.1f));
  }
}

TEST(TableFrame, IsOrthonormalForEveryNormal) {
  std::vector<vec3> normals{{0, 0, 1}, {0, 0, -1}, {1, 0, 0}, {0, -1, 0}, {1, 0, -0.0f}};
  Random random(1);
  for (int i = 0; i < 1000; ++i) normals.push_back(randomIncidence(random));
  normals.push_back(normalize(vec3(1e-4f, 0, -1)));
  for (const vec3& normal : normals) {
    const mat3 frame = vertexFrame(normal);
    const mat3 identity = glm::transpose(frame) * frame;
    for (int c = 0; c < 3; ++c)
      for (int r = 0; r < 3; ++r) ASSERT_NEAR(identity[c][r], c == r ? 1 : 0, 1e-5);
    ASSERT_NEAR(glm::determinant(frame), 1, 1e-5);
    ASSERT_EQ(frame[2], normal);
  }
}

// Two octahedral coordinates, each off by at most 1/65535 of [-1, 1]; the third by their sum; projected onto
// the sphere from no nearer than 1/sqrt(3): sqrt(1 + 1 + 4) sqrt(3) / 65535.
constexpr double kDirectionBound = 4.2427 / 65535;

TEST(TableQuantization, IsFinerThanThePapers) {
  static_assert(kDirectionBound < 0.0143e-2);
  const Mesh ball = ballMesh(16);
  const TransportTable table = exactBallTable(ball, 129);
  const vec3 extent = table.view().boxExtent;
  double worstPosition = 0;
  double worstDirection = 0;
  for (uint32_t vertex = 0; vertex < ball.positions.size(); ++vertex) {
    const mat3 frame = vertexFrame(ball.normals[vertex]);
    for (uint32_t i = 0; i < 129; ++i) {
      const vec3 incident = frame * sampledDirection(i, 8, 16);
      const OutgoingRay exact = rayThroughBall(ball.positions[vertex], incident, 1, kIor);
      const TableEntry entry = tableEntry(table.view(), 0, vertex, i);
      // Exits lie in the box of the ball's vertices but for the caps that its facets cut off; those are
      // clamped to it.
      const vec3 inBox =
          glm::clamp(exact.position, table.view().boxMinimum, table.view().boxMinimum + extent);
      const vec3 off = abs(entry.position - inBox) / extent;
      for (int axis = 0; axis < 3; ++axis) ASSERT_LE(off[axis], kHalfStep + 5e-7);
      worstPosition = std::max<double>(worstPosition, length(entry.position - inBox) / length(extent));
      worstDirection = std::max<double>(worstDirection, length(entry.direction - exact.direction));
      const float entering = 1 - fresnelReflectance(-dot(incident, ball.normals[vertex]), 1 / kIor);
      ASSERT_NEAR(entry.transmittance, exact.transmittance.x / entering, kHalfStep + 1e-6);
      ASSERT_NEAR(entry.pathLength, exact.pathLength, 2 * kHalfStep + 2e-6);
    }
  }
  EXPECT_LE(worstPosition, 0.0032e-2);
  EXPECT_LE(worstDirection, kDirectionBound + 5e-7);
  RecordProperty("worst_position_percent", std::to_string(100 * worstPosition));
  RecordProperty("worst_direction_percent", std::to_string(100 * worstDirection));
}

TEST(TableQuantization, OctahedralCodesHoldForEveryDirection) {
  Random random(5);
  for (int i = 0; i < 200000; ++i) {
    vec3 direction = randomIncidence(random);
    if (i % 2) direction.z = -direction.z;
    const vec2 code = glm::round(octahedralFromDirection(direction) * 65535.0f) / 65535.0f;
    ASSERT_LE(length(directionFromOctahedral(code) - direction), kDirectionBound + 5e-7);
  }
}

TEST(TableSize, OfThePapersBallIsUnder13Megabytes) {
  Mesh mesh;
  mesh.positions.resize(6400);
  EXPECT_LT(tableKey(mesh, vec3(kIor)).words() * sizeof(uint32_t), 13000000u);
  EXPECT_EQ(tableKey(mesh, vec3(1.51f, 1.52f, 1.53f)).bands(), 3u);
}

TEST(TableLookUp, AtASampledDirectionAnswersTheStoredRay) {
  const Mesh ball = ballMesh(8);
  const TransportTable table = exactBallTable(ball, 129);
  for (uint32_t vertex = 0; vertex < ball.positions.size(); vertex += 5) {
    for (uint32_t i = 0; i < 129; ++i) {
      const vec3 local = sampledDirection(i, 8, 16);
      const TableEntry entry = tableEntry(table.view(), 0, vertex, i);
      const OutgoingRay ray = lookUp(table, vertex, local);
      ASSERT_LT(length(ray.position - entry.position), 1e-5);
      ASSERT_LT(length(ray.direction - entry.direction), 1e-5);
      ASSERT_NEAR(ray.pathLength, entry.pathLength, 1e-5);
      ASSERT_NEAR(ray.transmittance.x, entry.transmittance * (1 - fresnelReflectance(-local.z, 1 / kIor)),
                  1e-5);
      ASSERT_EQ(ray.flags, 0u);
    }
  }
}

TEST(TableLookUp, ErrorFallsWithTheSquareOfTheSpacing) {
  const Mesh ball = ballMesh(16);
  const BallError coarse = errorOf(exactBallTable(ball, 129), ball);
  const BallError medium = errorOf(exactBallTable(ball, 513), ball);
  const BallError fine = errorOf(exactBallTable(ball, 2049), ball);
  // Bilinear: half the spacing, a quarter of the error; a third leaves room for the rays beyond the outermost
  // ring.
  EXPECT_LT(coarse.position, 0.02);
  EXPECT_LT(medium.position, coarse.position / 3);
  EXPECT_LT(fine.position, medium.position / 3);
  EXPECT_LT(coarse.direction, glm::radians(0.6));
  EXPECT_LT(medium.direction, 0.6 * coarse.direction);
  EXPECT_NEAR(coarse.flux, 1, 0.01);
  EXPECT_NEAR(medium.flux, 1, 0.003);
  EXPECT_NEAR(fine.flux, 1, 0.002);
}

TEST(TableLookUp, TracedBallFollowsTheClosedForm) {
  Mesh ball = ballMesh(40);
  const BallError flat = errorOf(tracedTable(ball), ball);
  EXPECT_LT(flat.position, 0.02);
  // Facets of 4.5 degrees lie up to 8e-4 of the radius inside the ball, which near grazing exits is
  // sqrt(2 x 8e-4) of angle.
  EXPECT_LT(flat.direction, std::sqrt(2 * 8e-4));
  EXPECT_NEAR(flat.flux, 1, 0.01);
  ball.isClosed = ball.isCurved = true;
  const BallError curved = errorOf(tracedTable(ball), ball);
  EXPECT_LT(curved.direction, flat.direction);
  EXPECT_NEAR(curved.flux, 1, 0.01);
}

TEST(TableLookUp, NeverMixesDifferentWays) {
  const Mesh ball = ballMesh(4);
  const vec3 one(1, 0, 0);
  const vec3 other(0, 1, 0);
  Progress progress;
  const auto trace = [&](uint32_t vertex, float, std::span<const vec3> incident,
                         std::span<OutgoingRay> rays) {
    for (std::size_t i = 0; i < incident.size(); ++i) {
      const float side = (incident[i] * vertexFrame(ball.normals[vertex])).x;
      rays[i] = {};
      rays[i].direction = side < 0.1f ? one : other;
      rays[i].signature = side < 0.1f ? 11 : 12;
      rays[i].transmittance = vec3(0.5f);
      if (side < -0.6f) rays[i].flags = kRayLost;
      if (side > 0.6f) rays[i].flags = kRayOccluded;
    }
  };
  const TransportTable table = fillTable(tableKey(ball, vec3(kIor)), ball, trace, progress);
  Random random(2);
  std::set<uint32_t> flags;
  for (int i = 0; i < 20000; ++i) {
    const OutgoingRay ray = lookUp(table, i % 20, randomIncidence(random));
    ASSERT_LT(std::min(length(ray.direction - one), length(ray.direction - other)), 2e-4);
    flags.insert(ray.flags);
  }
  EXPECT_EQ(flags, (std::set<uint32_t>{0, kRayLost, kRayOccluded}));
}

TEST(TableLookUp, LightFromBehindTheSurfaceCarriesNothing) {
  const Mesh ball = ballMesh(4);
  const OutgoingRay ray = lookUp(exactBallTable(ball, 9), 3, normalize(vec3(1, 0, 0.2f)));
  EXPECT_EQ(ray.flags, kRayLost);
  EXPECT_EQ(ray.transmittance, vec3(0));
}

TEST(TableBuild, FlagsWhatTheObjectItselfOccludes) {
  Mesh mesh = ballMesh(12);
  addBall(mesh, vec3(0, 3, 0), 1, 12);
  const TransportTable table = tracedTable(mesh);
  EXPECT_EQ(lookUp(table, 0, {0, 0, -1}).flags & kRayOccluded,
            kRayOccluded);  // top of the lower ball, under the other
  EXPECT_EQ(lookUp(table, 6 * 25, {0, 0, -1}).flags & kRayOccluded, 0u);  // its side
}

TEST(TableBuild, LeavesAndEntersAgain) {
  Mesh mesh = ballMesh(24);
  addBall(mesh, vec3(0, 3, 0), 1, 24);
  // Straight down through the upper ball, then through the lower one: two diameters of glass, four
  // boundaries.
  const OutgoingRay ray = lookUp(tracedTable(mesh), 25 * 49, {0, 0, -1});
  EXPECT_EQ(ray.flags, 0u);
  EXPECT_NEAR(ray.pathLength, 4, 0.05);
  EXPECT_NEAR(ray.position.y, -1, 0.02);
  EXPECT_NEAR(ray.transmittance.x, std::pow(0.96, 4), 0.005);
}

TEST(TableBuild, IsTheSameOnAnyNumberOfThreads) {
  const Mesh ball = ballMesh(12);
  std::vector<uint32_t> words;
  for (const std::size_t threads : {1, 2, 5}) {
    const oneapi::tbb::global_control limit(oneapi::tbb::global_control::max_allowed_parallelism, threads);
    const TransportTable table = tracedTable(ball, 33);
    if (words.empty()) words.assign(table.words().begin(), table.words().end());
    EXPECT_TRUE(std::equal(words.begin(), words.end(), table.words().begin(), table.words().end()));
  }
}

TEST(TableBuild, HoldsABandForEachIndexOfRefraction) {
  const Mesh ball = ballMesh(12);
  const vec3 ior(1.4f, 1.5f, 1.6f);
  const TransportTable dispersive = tracedTable(ball, 33, ior);
  const vec3 local = normalize(vec3(0.4f, 0.3f, -1));
  for (uint32_t band = 0; band < 3; ++band) {
    const TransportTable single = tracedTable(ball, 33, vec3(ior[int(band)]));
    const OutgoingRay expected = lookUp(single, 77, local);
    const OutgoingRay found = lookUp(dispersive, 77, local, band);
    EXPECT_EQ(found.direction, expected.direction);
    EXPECT_EQ(found.position, expected.position);
    EXPECT_EQ(found.transmittance, expected.transmittance);
    EXPECT_NEAR(found.pathLength, expected.pathLength, 1e-4);  // in units of the longest of all bands
  }
}

TEST(TableBuild, TakesAFlatMesh) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}};
  mesh.normals = {{0, 1, 0}, {0, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  mesh.isFinished = true;
  const OutgoingRay ray = lookUp(tracedTable(mesh, 9), 1, {0, 0, -1});
  EXPECT_TRUE(std::isfinite(ray.position.x + ray.direction.x + ray.pathLength + ray.transmittance.x));
}

// Two scenes that differ by one rigid motion and a scale of everything have rays that differ by the same.
TEST(TableRays, MoveWithTheObjectAndTraceNothing) {
  const Mesh ball = ballMesh(12);
  const TransportTable table = tracedTable(ball, 129);
  Material glass;
  glass.type = MaterialType::dielectric;
  glass.attenuationColor = {0.5f, 0.8f, 1.0f};
  glass.attenuationDistance = 2;
  Emitter emitter{};
  emitter.type = kEmitterPoint;
  emitter.position = {1, 4, 2};
  const Placement home;
  const Placement away{{3, -1, 2}, glm::angleAxis(0.7f, normalize(vec3(1, 2, 3))), 1.5f};
  Emitter moved = emitter;
  moved.position = away.point(emitter.position);
  std::vector<OutgoingRay> rays(ball.positions.size());
  std::vector<OutgoingRay> movedRays(ball.positions.size());

  const uint64_t tracedBefore = raysTraced();
  tableRays(table, ball, home, glass, emitter, 0, rays);
  tableRays(table, ball, away, glass, moved, 0, movedRays);
  EXPECT_EQ(raysTraced(), tracedBefore);

  int carrying = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    if (rays[i].flags != 0 || movedRays[i].flags != 0) continue;
    ++carrying;
    EXPECT_LT(length(movedRays[i].position - away.point(rays[i].position)), 1e-4);
    EXPECT_LT(length(movedRays[i].direction - away.direction(rays[i].direction)), 1e-4);
    EXPECT_NEAR(movedRays[i].pathLength, 1.5f * rays[i].pathLength, 1e-4);
    const vec3 local = emitterDirection(emitter, ball.positions[i]) * vertexFrame(ball.normals[i]);
    const vec3 absorbed = pow(glass.attenuationColor, vec3(rays[i].pathLength / 2));
    EXPECT_LT(length(rays[i].transmittance - lookUp(table, uint32_t(i), local).transmittance * absorbed),
              1e-5);
  }
  EXPECT_GT(carrying, 100);
}

}  // namespace
}  // namespace nephroid
