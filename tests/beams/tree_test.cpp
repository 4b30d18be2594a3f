#include <array>
#include <random>

#include <gtest/gtest.h>

#include "beams/footprint.h"
#include "beams/tree.h"
#include "transport/outgoing_ray.h"

namespace nephroid {
namespace {

// Beams that go any way, narrow and wide, with and without an end.
std::vector<Beam> randomBeams(uint32_t count) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> place(-2, 2), unit(-1, 1), small(-0.1f, 0.1f);
  std::vector<Beam> beams(count);
  for (Beam& beam : beams) {
    const float x = place(random), y = place(random), z = place(random);
    const float u = unit(random), v = unit(random), w = unit(random);
    const float reach = std::abs(place(random)) + 0.1f;
    const bool isEndless = unit(random) > 0.8f;
    for (int i = 0; i < 3; ++i) {
      const float a = small(random), b = small(random), c = small(random);
      beam.position[i] = vec3(x + a, y + b, z + c);
      beam.direction[i] = normalize(vec3(u + b, v + c, w + a) + vec3(1e-3f));
      beam.reach[i] = isEndless ? kUnboundedReach : reach * (1 + a);
    }
    beam.flux = vec3(1);
  }
  return beams;
}

TEST(BeamTree, HasEveryBeamOnceAndInItsOrder) {
  const std::vector<Beam> beams = randomBeams(1000);
  const BeamTree tree = buildBeamTree(std::array{beams, beams});
  ASSERT_EQ(tree.beams.size(), 2000u);
  std::vector<uint32_t> seen(2000, 0);
  const auto visit = [&](const auto& self, uint32_t group) -> void {
    for (uint32_t i = group; i < group + kChildren; ++i) {
      const BeamBounds& bounds = tree.bounds.at(i);
      if (bounds.nearest > bounds.farthest) continue;
      if (bounds.kind & kIsBeam)
        ++seen.at(bounds.first);
      else
        self(self, bounds.first);
    }
  };
  visit(visit, tree.root);
  for (const uint32_t times : seen) EXPECT_EQ(times, 1u);
}

// Wherever a beam has light, all bounds that it is in say so.
TEST(BeamTree, KeepsAllLightWithinItsBounds) {
  const BeamTree tree = buildBeamTree(std::array{randomBeams(3000)});
  std::mt19937 random(9);
  std::uniform_real_distribution<float> unit(0, 1);
  const auto check = [&](const auto& self, uint32_t group, std::vector<uint32_t> above) -> void {
    for (uint32_t i = group; i < group + kChildren; ++i) {
      const BeamBounds& bounds = tree.bounds.at(i);
      if (bounds.nearest > bounds.farthest) continue;
      std::vector<uint32_t> path = above;
      path.push_back(i);
      if (!(bounds.kind & kIsBeam)) {
        self(self, bounds.first, path);
        continue;
      }
      const Beam& beam = tree.beams[bounds.first];
      for (int sample = 0; sample < 4; ++sample) {
        float a = unit(random), b = unit(random);
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const float part = unit(random);
        vec3 point(0);
        const std::array weights{a, b, 1 - a - b};
        for (int c = 0; c < 3; ++c)
          point += weights[std::size_t(c)] *
                   (beam.position[c] + part * std::min(beam.reach[c], 4.0f) * beam.direction[c]);
        for (const uint32_t at : path)
          ASSERT_TRUE(boundsMeetBox(tree.bounds[at], point - 1e-5f, point + 1e-5f))
              << "beam " << bounds.first;
      }
    }
  };
  check(check, tree.root, {});
}

TEST(BeamTree, OfNoBeamsIsEmpty) {
  const BeamTree tree = buildBeamTree({});
  ASSERT_GE(tree.bounds.size(), kChildren);
  for (const BeamBounds& bounds : tree.bounds) EXPECT_GT(bounds.nearest, bounds.farthest);
}

// Texels side by side hold all of a footprint between them, whatever its size and shape.
TEST(Share, OfAllTexelsIsOne) {
  std::mt19937 random(11);
  std::uniform_real_distribution<float> place(3, 7), unit(-1, 1);
  for (const float size : {3.0f, 1.0f, 0.3f, 1e-2f, 1e-3f, 1e-5f, 0.0f})
    for (int i = 0; i < 300; ++i) {
      const float x = place(random), y = place(random);
      vec2 corners[3];
      for (vec2& corner : corners) {
        const float u = unit(random), v = unit(random);
        corner = vec2(x + size * u, y + (i % 3 == 0 ? 1e-3f : 1.0f) * size * v);
      }
      double sum = 0;
      for (int row = 0; row < 11; ++row)
        for (int column = 0; column < 11; ++column) {
          const vec2 texel{float(column), float(row)};
          sum += double(shareInTexel(corners[0] - texel, corners[1] - texel, corners[2] - texel));
        }
      // Each texel rounds the corners anew, against areas of some 1e-5 of a texel at the least.
      EXPECT_NEAR(sum, 1, 2e-2) << "size " << size << ", " << i;
    }
}

}  // namespace
}  // namespace nephroid
