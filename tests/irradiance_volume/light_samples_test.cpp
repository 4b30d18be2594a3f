// The light directions that irradiance volumes are made for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "geometry/shapes.h"
#include "support/irradiance_volumes.h"

namespace nephroid {
namespace {

TEST(LightSphere, SpreadsDirectionsAndFindsTheThreeAround) {
  for (const uint32_t level : {0u, 1u, 3u}) {
    const LightSphere sphere(level);
    EXPECT_EQ(sphere.directions().size(), 10u * (1u << (2 * level)) + 2);
    const float edge = 1.3f / float(1u << level);  // radians, above the longest
    for (int i = 0; i < 200; ++i) {
      const float z = -1 + (float(i) + 0.5f) / 100, azimuth = 2.4f * float(i);
      const float planar = std::sqrt(1 - z * z);
      const vec3 direction(planar * std::cos(azimuth), planar * std::sin(azimuth), z);
      const DirectionTriangle triangle = sphere.around(direction);
      vec3 blended(0);
      float sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        const vec3 vertex = sphere.directions()[triangle.vertex[k]];
        EXPECT_GT(dot(vertex, direction), std::cos(edge));
        blended += triangle.weight[k] * vertex;
        sum += triangle.weight[k];
      }
      EXPECT_NEAR(sum, 1, 1e-5f);
      EXPECT_NEAR(dot(normalize(blended), direction), 1, 1e-5f);
    }
  }
}

TEST(Symmetry, IsFoundInTheMesh) {
  EXPECT_TRUE(symmetryOf(makeSphere(0.5f, {.vertices = 2000})).isBall);
  const Symmetry ring = symmetryOf(makeRing(0.5f, 0.3f, 0.05f, {.vertices = 4000}));
  EXPECT_FALSE(ring.isBall);
  EXPECT_EQ(ring.axis, 1u);
  EXPECT_TRUE(ring.mirrors[1]);
  const Symmetry box = symmetryOf(makeBox(vec3(1, 1, 1)));
  EXPECT_EQ(box.axis, 3u);
  EXPECT_TRUE(box.mirrors[0] && box.mirrors[1] && box.mirrors[2]);
  const Symmetry prism = symmetryOf(makePrism(0.5f, 1.2f));
  EXPECT_EQ(prism.axis, 3u);
  EXPECT_TRUE(prism.mirrors[2]);
  EXPECT_FALSE(prism.mirrors[0] && prism.mirrors[1]);
  const Symmetry teapot = symmetryOf(makeTeapot(1));
  EXPECT_EQ(teapot.axis, 3u);
  EXPECT_FALSE(teapot.mirrors[0] && teapot.mirrors[2]);
}

TEST(LightSamples, LeaveOutWhatIsTheSame) {
  Symmetry none, ball, ring, box;
  ball.isBall = true;
  ring.axis = 1;
  ring.mirrors[1] = true;
  std::fill_n(box.mirrors, 3, true);
  EXPECT_EQ(LightSamples(none, 2).directions().size(), 162u);
  EXPECT_EQ(LightSamples(ball, 2).directions().size(), 1u);
  EXPECT_EQ(LightSamples(ring, 2).directions().size(), 7u);  // 15.9 degrees apart over 90
  EXPECT_EQ(LightSamples(box, 2).directions().size(), 27u);  // 8 * 27 less those on the planes
}

// The map to a sample takes the light's own direction near the sample's, and onto it where it is turned.
TEST(LightSamples, AreFoundByMapsOntoThem) {
  Symmetry none, ring, box;
  ring.axis = 2;
  std::fill_n(box.mirrors, 3, true);
  for (const Symmetry& symmetry : {none, ring, box}) {
    const LightSamples samples(symmetry, 2);
    for (const vec3 light :
         {vec3(0, -1, 0), vec3(0.3f, -0.8f, 0.2f), vec3(-0.7f, 0.1f, -0.5f), vec3(0, 0, -1)})
      for (const auto interpolation :
           {LightInterpolation::nearest, LightInterpolation::barycentric, LightInterpolation::rotated}) {
        float sum = 0;
        for (const SampleShare& share : samples.around(normalize(light), interpolation)) {
          const float cosine = dot(share.toSample * normalize(light), samples.directions()[share.sample]);
          EXPECT_GT(cosine, interpolation == LightInterpolation::rotated ? 0.99999f : std::cos(0.3f));
          sum += share.weight;
        }
        EXPECT_NEAR(sum, 1, 1e-5f);
      }
  }
}

}  // namespace
}  // namespace nephroid
