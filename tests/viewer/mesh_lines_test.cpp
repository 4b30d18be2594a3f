// The mesh of rays as lines over a picture.
#include "viewer/mesh_lines.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "support/ball_over_floor.h"
#include "techniques/level_color.h"

namespace nephroid {
namespace {

constexpr float kHeight = 0.8f;
constexpr std::size_t kAll = 1'000'000;

struct Traced {
  Scene scene;
  RayMesh mesh;
};

// A few thousand beams, some of them cut.
const Traced& traced() {
  static const Traced made = [] {
    Traced one{ballOverFloor(kHeight, {1.5f, 3.5f, 0}), {}};
    one.scene.meshes[0] = makeSphere(0.5f, {.vertices = 400});
    RayMeshSettings settings;
    settings.error = 0.1f;
    settings.detail = 0.005f;
    Progress progress;
    traceRayMesh(one.scene, RayScene(one.scene), settings, progress, one.mesh);
    return one;
  }();
  return made;
}

uint64_t countOf(const Legend& legend, const std::string& meaning) {
  const auto found = std::ranges::find(legend.entries, meaning, &Legend::Entry::meaning);
  return found == legend.entries.end() ? 0 : found->count;
}

using Ends = std::array<float, 6>;

Ends endsOf(vec3 a, vec3 b) {
  if (std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z)) std::swap(a, b);
  return {a.x, a.y, a.z, b.x, b.y, b.z};
}

TEST(MeshLines, TheLegendTellsWhatTheStatsTell) {
  const RayMesh& mesh = traced().mesh;
  const Legend legend = meshLegend(mesh);
  ASSERT_GT(mesh.stats.beamsByLevel[2], 0u);
  for (std::size_t cuts = 0; cuts < kToldLevels - 1; ++cuts)
    EXPECT_EQ(countOf(legend, "cut " + std::to_string(cuts) + (cuts == 1 ? " time" : " times")),
              mesh.stats.beamsByLevel[cuts]);
  EXPECT_EQ(countOf(legend, "single paths"), mesh.stats.singlePaths);
  const uint64_t all =
      std::accumulate(legend.entries.begin(), legend.entries.end(), uint64_t{0},
                      [](uint64_t sum, const Legend::Entry& entry) { return sum + entry.count; });
  EXPECT_EQ(all, mesh.beams.size());
}

// Where beams land, in the color of the finest beam that it belongs to.
TEST(MeshLines, EachSideIsDrawnOnceInTheColorOfItsCuts) {
  const RayMesh& mesh = traced().mesh;
  std::map<Ends, uint8_t> cutsOf;
  uint32_t most = 0;
  for (std::size_t i = 0; i < mesh.beams.size(); ++i) {
    if (mesh.beams[i].isPath) continue;
    most = std::max<uint32_t>(most, mesh.paths[i].cuts);
    for (int c = 0; c < 3; ++c) {
      uint8_t& cuts = cutsOf[endsOf(mesh.beams[i].corner[c], mesh.beams[i].corner[(c + 1) % 3])];
      cuts = std::max(cuts, mesh.paths[i].cuts);
    }
  }
  std::map<Ends, std::vector<vec3>> colors;
  std::size_t ofPaths = 0, landed = 0, onCaster = 0;
  for (const SceneLine& line : meshLines(mesh, kAll, 1).sides) {
    const Ends ends = endsOf(line.from, line.to);
    if (cutsOf.contains(ends)) {
      ++landed;
      colors[ends].push_back(line.color);
    } else if (std::abs(line.from.y) < 1e-4f) {
      ++ofPaths;
    } else {
      ++onCaster;
      EXPECT_NEAR(distance(line.from, vec3(0, kHeight, 0)), 0.5f, 0.03f);
      EXPECT_NEAR(distance(line.to, vec3(0, kHeight, 0)), 0.5f, 0.03f);
    }
  }
  for (const auto& [ends, cuts] : cutsOf)
    EXPECT_GE(std::ranges::count(colors[ends], levelColor(cuts, most + 1)), 1) << int(cuts);
  // Few corners of different beams are at the same place.
  EXPECT_LT(landed, cutsOf.size() * 101 / 100);
  EXPECT_EQ(ofPaths, 3 * mesh.stats.singlePaths);
  // Light of one triangle takes several ways to the floor.
  EXPECT_GT(onCaster, 500u);
  EXPECT_LT(onCaster, landed);
}

TEST(MeshLines, OfMoreBeamsThanAskedForSomeAreLeftOut) {
  const MeshLines some = meshLines(traced().mesh, 100, 10);
  EXPECT_LE(some.sides.size(), 600u);
  EXPECT_GT(some.sides.size(), 100u);
}

// From the ball to the floor, without a gap.
TEST(MeshLines, WaysGoFromTheCasterToWhereLightLands) {
  const std::vector<SceneLine> ways = meshLines(traced().mesh, kAll, 20).ways;
  std::size_t landed = 0;
  for (const SceneLine& line : ways) {
    EXPECT_NEAR(distance(line.from, vec3(0, kHeight, 0)), 0.5f, 0.01f);
    if (std::abs(line.to.y) < 1e-3f) {
      ++landed;
      continue;
    }
    const auto goesOn = [&](const SceneLine& other) { return other.from == line.to; };
    EXPECT_EQ(std::ranges::count_if(ways, goesOn), 1);
  }
  EXPECT_LE(landed, 20u);
  EXPECT_GE(landed, 10u);
}

TEST(MeshLines, WhatStandsBeforeALineHidesItAndItsOwnSurfaceDoesNot) {
  const Scene& scene = traced().scene;
  const RayScene rays(scene);
  const SceneLine onFloor{{2, 0, 0}, {2, 0, 0.1f}}, behindBall{{0.3f, 0, -1}, {0.3f, 0, -1.1f}},
      below{{2, -0.5f, 0}, {2, -0.5f, 0.1f}};
  std::vector<SceneLine> lines{behindBall, onFloor, below};
  removeHidden(rays, {0, 1.5f, 1}, lines);
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(lines[0].from, onFloor.from);
}

}  // namespace
}  // namespace nephroid
