#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "geometry/bounds.h"
#include "geometry/mesh_checks.h"
#include "geometry/shapes.h"
#include "water/water.h"

namespace nephroid {
namespace {

constexpr double kPi = std::numbers::pi;

struct ShapeCase {
  const char* name;
  Mesh (*make)(Density);
  double area;    // m^2, in closed form
  double volume;  // m^3
};

const ShapeCase kCases[] = {
    {"sphere", [](Density d) { return makeSphere(0.5f, d); }, kPi, kPi / 6},
    {"torus", [](Density d) { return makeTorus(0.5f, 0.2f, d); }, 4 * kPi* kPi * 0.1,
     2 * kPi* kPi * 0.5 * 0.04},
    {"box",
     [](Density d) {
       return makeBox({1, 2, 0.5f}, d);
     },
     7, 1},
    {"prism", [](Density d) { return makePrism(0.5f, 2, d); },
     3 * std::sqrt(3.0) + 2 * std::sqrt(3.0) * 3 / 16, 2 * std::sqrt(3.0) * 3 / 16},
    {"cylinder", [](Density d) { return makeCylinder(0.5f, 2, d); }, 2.5 * kPi, kPi / 2},
    {"ring", [](Density d) { return makeRing(0.5f, 0.25f, 0.1f, d); },
     2 * kPi * 1.1 * 0.25 + 2 * kPi*(0.36 - 0.25), kPi*(0.36 - 0.25) * 0.25},
};

class Shape : public testing::TestWithParam<ShapeCase> {};

TEST_P(Shape, IsClosedOutwardAndHasNoWastedTriangles) {
  for (const Density density : {Density{}, Density{1, 0}, Density{7, 0}, Density{0, 500}}) {
    const Mesh mesh = GetParam().make(density);
    const MeshTopology topology = meshTopology(mesh);
    EXPECT_TRUE(mesh.isClosed) << density.segments << " " << density.vertices;
    EXPECT_EQ(topology.boundaryEdges, 0u);
    EXPECT_EQ(topology.nonManifoldEdges, 0u);
    EXPECT_EQ(topology.flippedEdges, 0u);
    EXPECT_EQ(mesh.droppedTriangles, 0u);
    EXPECT_GT(topology.signedVolume, 0);
  }
}

TEST_P(Shape, ComesCloseToTheVerticesAskedFor) {
  for (const uint32_t vertices : {1600u, 6400u, 25600u}) {
    const Mesh mesh = GetParam().make({0, vertices});
    EXPECT_NEAR(static_cast<double>(mesh.positions.size()), vertices, 0.06 * vertices);
  }
}

// An inscribed mesh is short of the surface by the square of the edge, that is, by the inverse of the number
// of vertices.
TEST_P(Shape, ConvergesToTheClosedForm) {
  double lastError = 0;
  for (const uint32_t vertices : {1600u, 6400u, 25600u}) {
    const MeshTopology topology = meshTopology(GetParam().make({0, vertices}));
    const double error = std::abs(topology.signedVolume / GetParam().volume - 1) +
                         std::abs(topology.area / GetParam().area - 1);
    EXPECT_LT(error, 40.0 / vertices);
    if (vertices > 1600) {
      EXPECT_LT(error, std::max(0.4 * lastError, 1e-6));
    }
    lastError = error;
  }
}

TEST_P(Shape, NormalsAreUnitAndLookOutOfTheirTriangles) {
  const Mesh mesh = GetParam().make({0, 6400});
  ASSERT_EQ(mesh.normals.size(), mesh.positions.size());
  for (const vec3 normal : mesh.normals) ASSERT_NEAR(glm::length(normal), 1, 1e-5);
  for (const uvec3 t : mesh.triangles) {
    const vec3 face = glm::normalize(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
    for (int k = 0; k < 3; ++k) ASSERT_GT(glm::dot(face, mesh.normals[t[k]]), 0.97f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, Shape, testing::ValuesIn(kCases),
                         [](const auto& test) { return test.param.name; });

TEST(Shapes, SphereNormalsArePositionsAndTrianglesAreWellShaped) {
  const Mesh mesh = makeSphere(0.5f, {0, 6400});
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    ASSERT_LT(glm::distance(mesh.positions[i], 0.5f * mesh.normals[i]), 1e-6f);
  }
  for (const uvec3 t : mesh.triangles) {
    const float a = glm::distance(mesh.positions[t.x], mesh.positions[t.y]);
    const float b = glm::distance(mesh.positions[t.y], mesh.positions[t.z]);
    const float c = glm::distance(mesh.positions[t.z], mesh.positions[t.x]);
    ASSERT_LT(std::max({a, b, c}) / std::min({a, b, c}), 1.5f);
  }
}

TEST(Shapes, TorusNormalsAreItsGradient) {
  const Mesh mesh = makeTorus(0.5f, 0.2f);
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 p = mesh.positions[i];
    const vec3 center = 0.5f * glm::normalize(vec3(p.x, 0, p.z));
    ASSERT_LT(glm::distance(mesh.normals[i], (p - center) / 0.2f), 1e-5f);
  }
}

// A tube's volume is its section times the length of the line through its center, whatever way that bends.
TEST(Shapes, TorusKnotIsATubeOfTheLengthOfItsCurve) {
  const Mesh mesh = makeTorusKnot(2, 3, 0.5f, 0.1f, {0, 40000});
  double curve = 0;
  const int steps = 100000;
  for (int i = 0; i < steps; ++i) {
    curve += 0.25 * std::hypot(3.0, 2 * (2 + std::cos(3 * 2 * kPi * (i + 0.5) / steps))) * 2 * kPi / steps;
  }
  const MeshTopology topology = meshTopology(mesh);
  EXPECT_TRUE(mesh.isClosed);
  EXPECT_NEAR(topology.signedVolume, kPi * 0.01 * curve, 0.01 * kPi * 0.01 * curve);
  EXPECT_NEAR(static_cast<double>(mesh.positions.size()), 40000, 2000);
}

TEST(Shapes, TeapotIsThreeClosedSurfacesThatLookOutward) {
  for (const Density density : {Density{}, Density{4, 0}, Density{0, 20000}}) {
    const Mesh mesh = makeTeapot(1, density);
    const MeshTopology topology = meshTopology(mesh);
    EXPECT_TRUE(mesh.isClosed) << topology.boundaryEdges << " boundary edges";
    EXPECT_EQ(topology.flippedEdges, 0u);
    EXPECT_GT(topology.signedVolume, 0.05);
    float wrong = 0;
    for (const uvec3 t : mesh.triangles) {
      const vec3 face =
          glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
      for (int k = 0; k < 3; ++k) wrong += glm::dot(face, mesh.normals[t[k]]) <= 0 ? 1.0f : 0.0f;
    }
    // With two parts to a patch the lip of the spout is too coarse for that.
    if (density.segments == 0) {
      EXPECT_EQ(wrong, 0) << mesh.triangles.size();
    }
  }
  EXPECT_NEAR(static_cast<double>(makeTeapot(1, {0, 20000}).positions.size()), 20000, 1000);
}

TEST(Shapes, RingIsMeasuredToItsInnerWall) {
  const Mesh mesh = makeRing(0.5f, 0.25f, 0.02f);
  float inner = 1, outer = 0;
  for (const vec3 p : mesh.positions) {
    inner = std::min(inner, std::hypot(p.x, p.z));
    outer = std::max(outer, std::hypot(p.x, p.z));
    EXPECT_LE(std::abs(p.y), 0.125f);
  }
  EXPECT_NEAR(inner, 0.5, 1e-6);
  EXPECT_NEAR(outer, 0.52, 1e-6);
}

TEST(Shapes, PlaneIsAQuadThatFacesUp) {
  const Mesh mesh = makePlane({2, 3});
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_FALSE(mesh.isClosed);
  EXPECT_NEAR(meshTopology(mesh).area, 6, 1e-6);
  for (const vec3 n : mesh.normals) EXPECT_EQ(n, vec3(0, 1, 0));
  const uvec3 t = mesh.triangles[0];
  EXPECT_GT(
      glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).y, 0);
  EXPECT_NEAR(static_cast<double>(makePlane({2, 3}, {0, 1000}).positions.size()), 1000, 50);
}

TEST(Bounds, ABoxGrowsAroundWhatItHolds) {
  Box box;
  EXPECT_TRUE(box.isEmpty());
  box.include(vec3(1, 2, 3));
  EXPECT_FALSE(box.isEmpty());
  box.include(Box{{-1, 2, 0}, {0, 6, 3}});
  EXPECT_EQ(box.low, vec3(-1, 2, 0));
  EXPECT_EQ(box.high, vec3(1, 6, 3));
  EXPECT_EQ(box.center(), vec3(0, 4, 1.5f));
  EXPECT_EQ(box.longestSide(), 4);
  EXPECT_EQ(box.corner(5), vec3(1, 2, 3));
  EXPECT_TRUE(box.holds({1, 6, 3}));
  EXPECT_FALSE(box.holds({1, 6, 3.1f}));
  EXPECT_TRUE(box.holdsInside({{0, 3, 1}, {0.5f, 5, 2}}));
  EXPECT_FALSE(box.holdsInside(box));
}

TEST(Bounds, ATurnedBoxIsBoxedAnew) {
  Placement placement{{10, 0, 0}, glm::angleAxis(glm::radians(90.0f), vec3(0, 0, 1)), 2};
  const Mesh mesh = makeBox({1, 2, 3});
  const Box placed = placedBox(boundingBox(mesh), placement);
  EXPECT_LT(length(placed.low - vec3(8, -1, -3)), 1e-5f);
  EXPECT_LT(length(placed.high - vec3(12, 1, 3)), 1e-5f);
  EXPECT_NEAR(boundingSphere(mesh).radius, 0.5f * std::sqrt(14.0f), 1e-6);
}

TEST(Shapes, WaterFollowsItsFormulaAndItsNormalsTheGradient) {
  const Water water{
      {2, 1}, {41, 21}, {{0.05f, 0.7f, {1, 0}, 0.3f, 0.2f}, {0.02f, 0.3f, {0.6f, 0.8f}, -1, 0}}};
  const double time = 1.5;
  const Mesh mesh = makeWater(water, time);
  ASSERT_EQ(mesh.positions.size(), 41u * 21u);
  const auto heightOf = [&](const Wave& w, double x, double z) {
    return w.amplitude *
           std::sin(2 * kPi / w.wavelength * (w.direction.x * x + w.direction.y * z - w.speed * time) +
                    w.phase);
  };
  const auto height = [&](double x, double z) {
    double y = 0;
    for (const Wave& w : water.waves) y += heightOf(w, x, z);
    return y;
  };
  // What straight lines between vertices lose of it is made up for.
  const auto gradientOf = [&](const Wave& w, double x, double z) {
    const double e = 1e-5, phase = 2 * kPi / w.wavelength * 0.05 * length(w.direction);
    return (1 + std::min(phase * phase, 1.0) / 16) / (2 * e) *
           glm::dvec2(heightOf(w, x + e, z) - heightOf(w, x - e, z),
                      heightOf(w, x, z + e) - heightOf(w, x, z - e));
  };
  for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
    const vec3 p = mesh.positions[i];
    ASSERT_NEAR(p.y, height(p.x, p.z), 1e-6);
    glm::dvec2 gradient(0);
    for (const Wave& w : water.waves) gradient += gradientOf(w, p.x, p.z);
    ASSERT_LT(
        glm::distance(glm::dvec3(mesh.normals[i]), glm::normalize(glm::dvec3(-gradient.x, 1, -gradient.y))),
        1e-5);
  }
  EXPECT_NEAR(mesh.positions[5 * 41 + 3].x, -1 + 3 * 0.05, 1e-6);
  EXPECT_NEAR(mesh.positions[5 * 41 + 3].z, -0.5 + 5 * 0.05, 1e-6);
  for (const uvec3 t : mesh.triangles) {
    ASSERT_GT(
        glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]).y,
        0);
  }
}

}  // namespace
}  // namespace nephroid
