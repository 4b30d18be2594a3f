// What finishMesh mends in the faces of a mesh.
#include <gtest/gtest.h>

#include <cmath>

#include "geometry/mesh_checks.h"
#include "geometry/shapes.h"

namespace nephroid {
namespace {

// A cube of 8 vertices around `center` that looks outward.
Mesh cube(vec3 center = vec3(0), float half = 0.5f) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i)
    mesh.positions.push_back(center + half * vec3(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

void append(const Mesh& from, Mesh& to) {
  const auto first = uint32_t(to.positions.size());
  to.positions.insert(to.positions.end(), from.positions.begin(), from.positions.end());
  to.normals.insert(to.normals.end(), from.normals.begin(), from.normals.end());
  for (const uvec3& t : from.triangles) to.triangles.push_back(t + first);
}

void turn(Mesh& mesh) {
  for (uvec3& t : mesh.triangles) std::swap(t.y, t.z);
}

Mesh finished(Mesh mesh, Faces faces = Faces::outward) {
  finishMesh(mesh, "test", faces);
  return mesh;
}

// Every triangle and every normal looks away from the center.
void expectOutward(const Mesh& mesh, vec3 center = vec3(0)) {
  for (const uvec3& t : mesh.triangles) {
    const vec3 a = mesh.positions[t.x], b = mesh.positions[t.y], c = mesh.positions[t.z];
    EXPECT_GT(dot(cross(b - a, c - a), a + b + c - 3.0f * center), 0);
  }
  for (std::size_t i = 0; i < mesh.positions.size(); ++i)
    EXPECT_GT(dot(mesh.normals[i], mesh.positions[i] - center), 0);
}

TEST(MeshRepairs, AMeshThatIsRightStaysAsItIs) {
  const Mesh mesh = finished(cube());
  EXPECT_TRUE(mesh.isClosed);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_EQ(mesh.findings.turnedParts + mesh.findings.repeatedTriangles + mesh.findings.inwardParts, 0u);
  expectOutward(mesh);
}

TEST(MeshRepairs, AClosedPartThatLooksInwardIsTurned) {
  Mesh inward = cube();
  turn(inward);
  const Mesh mesh = finished(inward);
  EXPECT_EQ(mesh.findings.turnedParts, 1u);
  EXPECT_EQ(mesh.findings.turnedTriangles, 12u);
  expectOutward(mesh);
  const Mesh kept = finished(inward, Faces::asGiven);
  EXPECT_EQ(kept.findings.turnedParts, 0u);
  EXPECT_EQ(kept.findings.inwardParts, 1u);
  EXPECT_NEAR(meshTopology(kept).signedVolume, -1, 1e-6);
}

// Normals may be turned with the faces, or have been right all along.
TEST(MeshRepairs, GivenNormalsLookTheWayTheTurnedFacesDo) {
  for (const float side : {-1.0f, 1.0f}) {
    Mesh ball = makeSphere(1, {.vertices = 200});
    turn(ball);
    for (vec3& normal : ball.normals) normal *= side;
    expectOutward(finished(ball));
  }
}

TEST(MeshRepairs, OnePartInsideOutIsTurnedAndTheOtherIsNot) {
  Mesh both = cube(vec3(-2, 0, 0)), inward = cube(vec3(2, 0, 0));
  turn(inward);
  append(inward, both);
  const Mesh mesh = finished(both);
  EXPECT_EQ(mesh.findings.turnedParts, 1u);
  EXPECT_EQ(mesh.findings.turnedTriangles, 12u);
  EXPECT_NEAR(meshTopology(mesh).signedVolume, 2, 1e-6);
  // Also within another, where it could be a bubble.
  Mesh nested = cube(vec3(0), 2);
  inward = cube();
  turn(inward);
  append(inward, nested);
  EXPECT_EQ(finished(nested).findings.turnedParts, 1u);
  EXPECT_EQ(finished(nested, Faces::asGiven).findings.inwardParts, 1u);
}

TEST(MeshRepairs, AVertexOfATurnedPartAndAnotherIsDoubled) {
  Mesh both = cube(vec3(-0.5f)), inward = cube(vec3(0.5f));
  both.normals.assign(8, vec3(0));
  for (std::size_t i = 0; i < 8; ++i) both.normals[i] = normalize(both.positions[i] + vec3(0.5f));
  // The corner at the origin, number 7 of the one and number 0 of the other, is one vertex.
  turn(inward);
  for (std::size_t i = 1; i < 8; ++i) {
    both.positions.push_back(inward.positions[i]);
    both.normals.push_back(-normalize(inward.positions[i] - vec3(0.5f)));
  }
  for (const uvec3& t : inward.triangles)
    both.triangles.emplace_back(t.x ? t.x + 7 : 7, t.y ? t.y + 7 : 7, t.z ? t.z + 7 : 7);
  const Mesh mesh = finished(both);
  ASSERT_EQ(mesh.positions.size(), 48u);  // each side of both has a normal of its own
  for (const uvec3& t : mesh.triangles) {
    const vec3 middle = (mesh.positions[t.x] + mesh.positions[t.y] + mesh.positions[t.z]) / 3.0f;
    const vec3 center(middle.x + middle.y + middle.z < 0 ? -0.5f : 0.5f);
    for (int k = 0; k < 3; ++k) EXPECT_GT(dot(mesh.normals[t[k]], mesh.positions[t[k]] - center), 0);
  }
}

TEST(MeshRepairs, FacesOfAPartThatRunAgainstEachOtherAreMadeAlike) {
  Mesh mixed = cube();
  for (const std::size_t t : {1u, 4u, 7u}) std::swap(mixed.triangles[t].y, mixed.triangles[t].z);
  const Mesh mesh = finished(mixed);
  EXPECT_EQ(mesh.findings.turnedTriangles, 3u);
  EXPECT_EQ(mesh.findings.flippedEdges, 0u);
  expectOutward(mesh);
}

TEST(MeshRepairs, OpenMeshesAreNotTurned) {
  Mesh open = cube();
  turn(open);
  open.triangles.pop_back();
  const Mesh mesh = finished(open);
  EXPECT_FALSE(mesh.isClosed);
  EXPECT_EQ(mesh.findings.boundaryEdges, 3u);
  EXPECT_EQ(mesh.findings.turnedParts, 0u);
}

void expectSame(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.positions, b.positions);
  EXPECT_EQ(a.normals, b.normals);
  EXPECT_EQ(a.triangles, b.triangles);
}

TEST(MeshRepairs, ADoubledMeshIsTheSingleOne) {
  const Mesh single = finished(cube());
  Mesh twice = cube(), doubleSided = cube(), other = cube();
  append(cube(), twice);
  turn(other);
  append(other, doubleSided);
  for (const Mesh& doubled : {twice, doubleSided}) {
    const Mesh mesh = finished(doubled);
    EXPECT_EQ(mesh.findings.repeatedTriangles, 12u);
    EXPECT_EQ(mesh.findings.turnedParts, 0u);
    expectSame(mesh, single);
  }
  // With the reversed copies first, the second ones are kept.
  append(cube(), other);
  const Mesh mesh = finished(other);
  EXPECT_EQ(mesh.findings.repeatedTriangles, 12u);
  EXPECT_EQ(mesh.findings.turnedParts, 0u);
  expectSame(mesh, single);
}

TEST(MeshRepairs, TheWallBetweenPartsThatAreGluedGoes) {
  Mesh glued = cube(vec3(-0.5f, 0, 0)), right = cube(vec3(0.5f, 0, 0));
  // The diagonals of the common wall have to be the same.
  right.triangles[8] = {0, 4, 6};
  glued.triangles[10] = {1, 7, 5};
  glued.triangles[11] = {1, 3, 7};
  append(right, glued);
  const Mesh mesh = finished(glued);
  EXPECT_EQ(mesh.findings.repeatedTriangles, 4u);
  EXPECT_TRUE(mesh.isClosed);
  EXPECT_EQ(mesh.triangles.size(), 20u);
  EXPECT_NEAR(meshTopology(mesh).signedVolume, 2, 1e-6);
}

// A leaf with two sides on a trunk is seen; it must not vanish.
TEST(MeshRepairs, ASheetWithTwoSidesThatIsFixedToSomethingStays) {
  Mesh mesh = cube();
  mesh.positions.push_back(vec3(0, 0, 3));
  mesh.triangles.push_back({4, 5, 8});
  mesh.triangles.push_back({4, 8, 5});
  EXPECT_EQ(finished(mesh).findings.repeatedTriangles, 0u);
}

// A ball as exporters write it: the last column of vertices is the first, but for rounding.
Mesh ballWithSeam(vec3 center, float gap) {
  constexpr uint32_t kRows = 12, kColumns = 24;
  Mesh mesh;
  for (uint32_t row = 0; row <= kRows; ++row)
    for (uint32_t column = 0; column <= kColumns; ++column) {
      const double theta = M_PI * row / kRows, phi = 2 * M_PI * (column % kColumns) / kColumns;
      vec3 p(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
      if (row == 0 || row == kRows) p.x = p.z = 0;
      if (column == kColumns) p.z -= gap;
      mesh.positions.push_back(center + p);
    }
  for (uint32_t row = 0; row < kRows; ++row)
    for (uint32_t column = 0; column < kColumns; ++column) {
      const uint32_t a = row * (kColumns + 1) + column, b = a + 1, c = a + kColumns + 1, d = c + 1;
      mesh.triangles.push_back({a, b, d});
      mesh.triangles.push_back({a, d, c});
    }
  return mesh;
}

TEST(MeshRepairs, ASeamAsNarrowAsRoundingIsClosed) {
  for (const float gap : {1e-16f, 1e-7f, 3e-7f}) {
    const Mesh mesh = finished(ballWithSeam(vec3(0), gap));
    EXPECT_TRUE(mesh.isClosed) << gap;
    EXPECT_EQ(mesh.findings.boundaryEdges, 0u);
    // No crease where the seam was: normals there are those of a ball.
    for (std::size_t i = 0; i < mesh.positions.size(); ++i)
      EXPECT_GT(dot(mesh.normals[i], normalize(mesh.positions[i])), 0.998f);
  }
  // Far from the origin coordinates are coarser.
  EXPECT_TRUE(finished(ballWithSeam(vec3(500, 0, 0), 1e-4f)).isClosed);
  EXPECT_FALSE(finished(ballWithSeam(vec3(0), 1e-5f)).isClosed);
}

TEST(MeshRepairs, SeamsAreNotClosedAcrossSmallThings) {
  // Two sheets nearer to each other than rounding is on the whole, but not than their own edges are long.
  Mesh mesh;
  const float fine = 2e-7f;
  for (const float z : {0.0f, fine}) {
    const auto first = uint32_t(mesh.positions.size());
    for (const vec3 p : {vec3(0, 0, z), vec3(fine, 0, z), vec3(0, fine, z)}) mesh.positions.push_back(p);
    mesh.triangles.push_back(uvec3(first, first + 1, first + 2));
  }
  const auto first = uint32_t(mesh.positions.size());
  for (const vec3 p : {vec3(1, 0, 0), vec3(1, 1, 0), vec3(1, 0, 1)}) mesh.positions.push_back(p);
  mesh.triangles.push_back(uvec3(first, first + 1, first + 2));
  EXPECT_EQ(finished(mesh).positions.size(), 9u);
}

}  // namespace
}  // namespace nephroid
